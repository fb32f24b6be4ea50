//! [`LogicalLines`]: splits an OBJ file into logical lines, without comments and continuations.

use std::io::{BufRead, Read};

use super::error::{Failure, ObjProblem};

/// Maximum length of a logical line without its comments, in bytes. A face of that length has some
/// 100,000 corners.
pub(super) const MAX_LINE: usize = 1 << 20;

/// Maximum length of a chunk, in bytes.
const CHUNK: u64 = 1 << 16;

/// The UTF-8 byte order mark.
const MARK: &[u8] = b"\xEF\xBB\xBF";

/// Whether `byte` separates words: the ASCII part of `str::split_whitespace`.
pub(super) const fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | 9..=13)
}

/// Splits bytes into logical lines.
///
/// - A line ends in LF, CR LF, a lone CR or the end of the input. UTF-8 byte order marks at its
///   start are skipped, on any line: they remain where files were joined.
/// - A comment runs from `#` to the end of its line and may hold any bytes, any number of them. A
///   `#` after a dot is no comment but part of a number such as `1.#IND`, which is how old C
///   libraries write infinity.
/// - A backslash at the end of a line, before any comment, continues it on the next line. A
///   backslash within a comment does not: there it is usually the end of a Windows path.
///
/// It keeps one chunk and one line, whatever the input is.
pub(in crate::shape) struct LogicalLines<R> {
    input: R,
    /// The input up to and including a line feed, or up to [`CHUNK`] bytes of it.
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
    ///
    /// # Errors
    /// If reading fails, or the line is longer than [`MAX_LINE`].
    pub fn next(&mut self) -> Result<Option<(u64, &[u8])>, Failure> {
        let number = self.begun + 1;
        if self.at == self.chunk.len() {
            if !self.read_chunk()? {
                return Ok(None);
            }
            // Fast path for nearly every line: whole, without comment, continuation or CR, so it
            // is returned without a copy.
            if let Some(length) = plain(&self.chunk) {
                self.at = self.chunk.len();
                self.begun += 1;
                return Ok(Some((number, without_marks(&self.chunk[..length]))));
            }
        }

        self.edited.clear();
        while self.edit_physical_line(number)? {
            if self.at == self.chunk.len() && !self.read_chunk()? {
                break;
            }
        }
        Ok(Some((number, &self.edited)))
    }

    /// Reads the next chunk. `false` at the end of the input.
    fn read_chunk(&mut self) -> Result<bool, Failure> {
        self.chunk.clear();
        self.at = 0;
        let mut input = self.input.by_ref().take(CHUNK);
        input.read_until(b'\n', &mut self.chunk).map_err(Failure::Io)?;
        Ok(!self.chunk.is_empty())
    }

    /// Appends the next physical line to `edited`, in as many chunks as it has. Returns whether it
    /// is continued. `number` is that of the logical line.
    fn edit_physical_line(&mut self, number: u64) -> Result<bool, Failure> {
        self.begun += 1;
        let start = self.edited.len();
        let mut in_comment = false;
        loop {
            let rest = &self.chunk[self.at..];
            let end = rest.iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(rest.len());
            if !in_comment {
                in_comment = append(&mut self.edited, start, &rest[..end]);
            }
            if self.edited.len() > MAX_LINE {
                return Err(Failure::Line(number, ObjProblem::LongLine));
            }
            self.at += end;
            if self.at < self.chunk.len() {
                break self.skip_line_end()?;
            }
            if !self.read_chunk()? {
                break;
            }
        }

        let line = &self.edited[start..];
        let marks = line.len() - without_marks(line).len();
        self.edited.drain(start..start + marks);
        let last = self.edited.iter().rposition(|&b| !is_blank(b));
        let end = last.filter(|&last| last >= start && self.edited[last] == b'\\');
        if let Some(end) = end {
            self.edited.truncate(end);
            self.edited.push(b' ');
        }
        Ok(end.is_some())
    }

    /// Skips LF, CR LF or CR.
    fn skip_line_end(&mut self) -> Result<(), Failure> {
        let is_return = self.chunk[self.at] == b'\r';
        self.at += 1;
        if is_return {
            if self.at == self.chunk.len() {
                self.read_chunk()?;
            }
            self.at += usize::from(self.chunk.get(self.at) == Some(&b'\n'));
        }
        Ok(())
    }
}

/// Length of the line in a chunk if it is whole, and the text before its LF or CR LF is the logical
/// line.
#[inline]
fn plain(chunk: &[u8]) -> Option<usize> {
    let line = chunk.strip_suffix(b"\n")?;
    let line = line.strip_suffix(b"\r").unwrap_or(line);
    let is_plain = !line.iter().fold(false, |found, &b| found | matches!(b, b'\r' | b'#' | b'\\'));
    is_plain.then_some(line.len())
}

/// Appends `text` up to a comment to the line that begins at `start` of `edited`. Returns whether
/// there is one.
fn append(edited: &mut Vec<u8>, start: usize, text: &[u8]) -> bool {
    let before = edited[start..].last().copied();
    let is_comment = |&i: &usize| {
        text[i] == b'#' && if i == 0 { before } else { Some(text[i - 1]) } != Some(b'.')
    };
    let comment = (0..text.len()).find(is_comment);
    edited.extend_from_slice(&text[..comment.unwrap_or(text.len())]);
    comment.is_some()
}

#[inline]
fn without_marks(mut line: &[u8]) -> &[u8] {
    while let Some(rest) = line.strip_prefix(MARK) {
        line = rest;
    }
    line
}

#[cfg(test)]
mod tests {
    use std::io::BufReader;

    use super::*;

    /// All lines with their numbers, read through a buffer of three bytes.
    fn lines(text: &[u8]) -> Vec<(u64, String)> {
        let mut lines = LogicalLines::new(BufReader::with_capacity(3, text));
        let mut all = Vec::new();
        while let Ok(Some((number, line))) = lines.next() {
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

    // Broken by: comments read as part of a line.
    #[test]
    fn comments_are_not_kept() {
        let text = [&b"a # "[..], &b"x".repeat(8 << 20), b"\nb"].concat();
        let mut lines = LogicalLines::new(&text[..]);
        for expected in ["a ", "b"] {
            assert!(matches!(lines.next(), Ok(Some((_, line))) if line == expected.as_bytes()));
        }
        assert!(lines.chunk.capacity() + lines.edited.capacity() < 1 << 18);
    }

    // Each line around the length of a chunk: a comment, a number with `#`, CR LF, a continuation or
    // a byte order mark lies across two chunks. Broken by: a line's state forgotten between them.
    #[test]
    fn lines_are_the_same_across_chunks() {
        let chunk = CHUNK as usize;
        for before in chunk - 8..=chunk + 8 {
            let pad = "x".repeat(before - 4);
            let text = format!("{pad} 1.#IND # c\r\nab \\\r\ncd\re\n");
            let all = lines(text.as_bytes());
            let expected = [(1, format!("{pad} 1.#IND ")), (2, "ab  cd".into()), (4, "e".into())];
            assert_eq!(all, expected, "{before}");
            // Lone returns keep all of it in one line for the reader.
            let text = format!("{pad}\r\u{FEFF}ab\\ \r\u{FEFF}cd#\r\re");
            let expected = [(1, pad), (2, "ab cd".into()), (4, String::new()), (5, "e".into())];
            assert_eq!(lines(text.as_bytes()), expected, "{before}");
        }
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
