//! [`LogicalLines`]: splits an OBJ file into logical lines, without comments and continuations.

use std::io::{self, BufRead};

/// Whether `byte` separates words: the ASCII part of `str::split_whitespace`.
pub(super) const fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | 9..=13)
}

/// Splits bytes into logical lines.
///
/// - A line ends in LF, CR LF, a lone CR or the end of the input. A UTF-8 byte order mark is
///   skipped.
/// - A comment runs from `#` to the end of its line and may hold any bytes. A `#` after a dot is no
///   comment but part of a number such as `1.#INF`, which is how old C libraries write infinity.
/// - A backslash at the end of a line, before any comment, continues it on the next line. A
///   backslash within a comment does not: there it is usually the end of a Windows path.
pub(super) struct LogicalLines<R> {
    input: R,
    /// The input up to a line feed: one line, or several that end in a lone CR.
    chunk: Vec<u8>,
    /// Start of the unread part of `chunk`.
    at: usize,
    /// A logical line that is not a contiguous part of `chunk`.
    edited: Vec<u8>,
    /// Number of physical lines read.
    begun: u64,
}

impl<R: BufRead> LogicalLines<R> {
    pub fn new(input: R) -> Self {
        Self { input, chunk: Vec::new(), at: 0, edited: Vec::new(), begun: 0 }
    }

    /// The next logical line and the number of its first physical line, counted from 1. `None` at
    /// the end of the input.
    pub fn next(&mut self) -> io::Result<Option<(u64, &[u8])>> {
        if self.at == self.chunk.len() && !self.read_chunk()? {
            return Ok(None);
        }
        let number = self.begun + 1;

        // Fast path for nearly every line: no comment, continuation or CR, so it is returned
        // without a copy.
        let text = without_line_end(&self.chunk[self.at..]);
        if !text.iter().fold(false, |found, &b| found | matches!(b, b'\r' | b'#' | b'\\')) {
            let range = self.at..self.at + text.len();
            self.at = self.chunk.len();
            self.begun += 1;
            return Ok(Some((number, &self.chunk[range])));
        }

        self.edited.clear();
        while self.edit_physical_line() {
            if self.at == self.chunk.len() && !self.read_chunk()? {
                break;
            }
        }
        Ok(Some((number, &self.edited)))
    }

    /// Reads the next chunk. `false` at the end of the input.
    fn read_chunk(&mut self) -> io::Result<bool> {
        self.chunk.clear();
        self.at = 0;
        self.input.read_until(b'\n', &mut self.chunk)?;
        if self.begun == 0 && self.chunk.starts_with(b"\xEF\xBB\xBF") {
            self.at = 3;
        }
        Ok(!self.chunk.is_empty())
    }

    /// Appends the next physical line of the chunk to `edited`. Returns whether it is continued.
    fn edit_physical_line(&mut self) -> bool {
        self.begun += 1;
        let rest = &self.chunk[self.at..];
        let end = rest.iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(rest.len());
        let line_end = if rest[end..].starts_with(b"\r\n") { 2 } else { 1 };
        self.at = (self.at + end + line_end).min(self.chunk.len());

        let text = &rest[..end];
        let is_comment = |&i: &usize| text[i] == b'#' && (i == 0 || text[i - 1] != b'.');
        let text = &text[..(0..end).find(is_comment).unwrap_or(end)];
        let last = text.iter().rposition(|&b| !is_blank(b));
        if let Some(last) = last.filter(|&last| text[last] == b'\\') {
            self.edited.extend_from_slice(&text[..last]);
            self.edited.push(b' ');
            true
        } else {
            self.edited.extend_from_slice(text);
            false
        }
    }
}

fn without_line_end(chunk: &[u8]) -> &[u8] {
    let line = chunk.strip_suffix(b"\n").unwrap_or(chunk);
    line.strip_suffix(b"\r").unwrap_or(line)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All lines with their numbers, read through a buffer of three bytes.
    fn lines(text: &[u8]) -> Vec<(u64, String)> {
        let mut lines = LogicalLines::new(io::BufReader::with_capacity(3, text));
        let mut all = Vec::new();
        while let Some((number, line)) = lines.next().unwrap() {
            all.push((number, String::from_utf8_lossy(line).into_owned()));
        }
        all
    }

    fn owned(lines: &[(u64, &str)]) -> Vec<(u64, String)> {
        lines.iter().map(|&(n, s)| (n, s.to_owned())).collect()
    }

    #[test]
    fn every_line_end_counts_once() {
        let expected = owned(&[(1, "a"), (2, "b"), (3, ""), (4, "c")]);
        for text in
            ["a\nb\n\nc", "a\r\nb\r\n\r\nc\r\n", "a\rb\r\rc\r", "a\rb\n\r\nc", "a\r\nb\r\rc\n"]
        {
            assert_eq!(lines(text.as_bytes()), expected, "{text:?}");
        }
        assert_eq!(lines(b""), []);
        assert_eq!(lines(b"\xEF\xBB\xBF"), [(1, String::new())]);
        assert_eq!(lines(b"\xEF\xBB\xBFa\n\xEF"), owned(&[(1, "a"), (2, "\u{FFFD}")]));
    }

    #[test]
    fn comments_go_and_continuations_join() {
        assert_eq!(lines(b"a # b\n#\xE9\nc#\n"), owned(&[(1, "a "), (2, ""), (3, "c")]));
        assert_eq!(lines(b"v 1.#IND #\n.#"), owned(&[(1, "v 1.#IND "), (2, ".#")]));
        assert_eq!(lines(b"a\\\nb \\ \r\nc\nd"), owned(&[(1, "a b  c"), (4, "d")]));
        assert_eq!(lines(b"a \\ # b\nc"), owned(&[(1, "a  c")]));
        // A backslash in a comment, within a line, and at the very end.
        assert_eq!(lines(b"# C:\\a\\\nb\\c\nd\\"), owned(&[(1, ""), (2, "b\\c"), (3, "d ")]));
    }
}
