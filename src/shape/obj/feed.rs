//! [`Feed`]: the filter between an OBJ file and tobj.

use std::io::{self, BufRead, ErrorKind, Read, Write};

use super::error::{Failure, ObjAttribute, ObjProblem, excerpt};
use super::faces::Faces;
use super::keywords::is_ignored;
use super::line_table::LineTable;
use super::lines::{LogicalLines, is_blank};
use super::materials::Materials;
use super::report::SkippedLines;

/// Corners in each closing face of the feed; the last may have fewer. Small faces are faster,
/// because tobj looks each corner up in a hash table of its object.
pub(super) const CLOSING_CORNERS: usize = 1024;

/// A filter between the file and tobj, which reads it in place of the file.
///
/// - `v`, `vt` and `vn` lines pass, one at a time, truncated to the numbers that are used. tobj
///   parses the numbers.
/// - `f` lines are parsed here, by [`Faces`]. Errors in indices need the line, and tobj would
///   renumber vertices by hashing each corner.
/// - `usemtl` and `mtllib` lines go to [`Materials`].
/// - All other lines are dropped: names, points, lines, curves. Those with an unknown
///   keyword are counted.
///
/// tobj returns only the elements that faces refer to, in order of first use. So the feed ends with
/// closing faces of its own, which refer to each element once, in the order of the file. Each is an
/// object by itself.
pub(super) struct Feed<R> {
    lines: LogicalLines<R>,
    /// The faces of the file.
    pub faces: Faces,
    /// The lines of vertices, texture coordinates and normals.
    pub line_tables: [LineTable; 3],
    /// The materials of the faces.
    pub materials: Materials,
    /// Lines with an unknown keyword.
    pub unknown: SkippedLines,
    /// The text that tobj is reading.
    out: Vec<u8>,
    /// How many bytes of `out` tobj has read.
    taken: usize,
    /// Kind and line number of the line in `out`.
    origin: (ObjAttribute, u64),
    /// First corner of the next closing face; `None` before the end of the file.
    closing: Option<usize>,
    /// The error that ended the feed; tobj only learns that there was one.
    failure: Option<Failure>,
}

impl<R: BufRead> Feed<R> {
    pub fn new(input: R) -> Self {
        Self {
            lines: LogicalLines::new(input),
            faces: Faces::default(),
            line_tables: Default::default(),
            materials: Materials::default(),
            unknown: SkippedLines::default(),
            out: Vec::new(),
            taken: 0,
            origin: (ObjAttribute::Vertex, 0),
            closing: None,
            failure: None,
        }
    }

    /// The numbers of vertices, texture coordinates and normals read so far.
    pub fn counts(&self) -> [usize; 3] {
        self.line_tables.each_ref().map(LineTable::count)
    }

    /// The cause of tobj's error: that of the feed, or else an invalid number in the line read
    /// last.
    pub fn into_failure(self, error: tobj::LoadError) -> Failure {
        if let Some(failure) = self.failure {
            return failure;
        }
        let (attribute, line) = self.origin;
        let is_number = |word: &str| word.parse::<f32>().is_ok();
        // The feed sends only ASCII.
        let sent = str::from_utf8(&self.out).unwrap_or_default();
        match sent.split_whitespace().skip(1).find(|word| !is_number(word)) {
            Some(word) => Failure::Line(line, bad_number(attribute, word.as_bytes())),
            None => Failure::Io(io::Error::new(ErrorKind::InvalidData, error)),
        }
    }

    /// Fills `out` with the next line for tobj; leaves it empty at the end.
    fn advance(&mut self) -> Result<(), Failure> {
        self.out.clear();
        self.taken = 0;
        while self.closing.is_none() {
            let counts = self.counts();
            let Some((number, line)) = self.lines.next()? else {
                self.finish(counts)?;
                break;
            };
            let (word, rest) = split_word(line);
            let attribute = match word {
                b"v" => ObjAttribute::Vertex,
                b"vt" => ObjAttribute::Texture,
                b"vn" => ObjAttribute::Normal,
                b"f" => {
                    self.faces.add(rest, number, counts).map_err(|p| Failure::Line(number, p))?;
                    self.materials.extend(self.faces.vertices.len());
                    continue;
                }
                b"usemtl" => {
                    self.materials.select(rest);
                    continue;
                }
                b"mtllib" => {
                    self.materials.library(rest);
                    continue;
                }
                _ if number == 1
                    && (word.starts_with(b"\xFF\xFE") || word.starts_with(b"\xFE\xFF")) =>
                {
                    return Err(Failure::Line(number, ObjProblem::Utf16));
                }
                _ => {
                    if !is_ignored(word) {
                        self.unknown.add(number);
                    }
                    continue;
                }
            };
            cut(attribute, rest, &mut self.out).map_err(|p| Failure::Line(number, p))?;
            self.line_tables[attribute as usize].push(number);
            self.origin = (attribute, number);
            return Ok(());
        }
        self.close();
        Ok(())
    }

    /// Validates what needs the whole file.
    fn finish(&mut self, counts: [usize; 3]) -> Result<(), Failure> {
        self.faces.finish(counts).map_err(|(line, problem)| Failure::Line(line, problem))?;
        if self.faces.vertices.is_empty() {
            return Err(Failure::NoFaces(counts[0]));
        }
        for (what, count) in [
            ("vertices", counts[0]),
            ("texture coordinates", counts[1]),
            ("normals", counts[2]),
            ("triangles", self.faces.vertices.len()),
        ] {
            if u32::try_from(count).is_err() {
                return Err(Failure::TooMany(what));
            }
        }
        self.closing = Some(0);
        Ok(())
    }

    /// Writes the next closing face. Corner `i` refers to vertex, texture coordinate and normal
    /// `i`, or to the last one of a shorter list.
    fn close(&mut self) {
        let [vertices, textures, normals] = self.counts();
        let start = self.closing.unwrap_or_default();
        let end = vertices.max(textures).max(normals).min(start + CLOSING_CORNERS);
        if start < end {
            self.out.push(b'f');
        }
        for i in start + 1..=end {
            let (v, vt, vn) = (i.min(vertices), i.min(textures), i.min(normals));
            // Writing to a Vec never fails.
            let _ = match (textures > 0, normals > 0) {
                (false, false) => write!(self.out, " {v}"),
                (true, false) => write!(self.out, " {v}/{vt}"),
                (false, true) => write!(self.out, " {v}//{vn}"),
                (true, true) => write!(self.out, " {v}/{vt}/{vn}"),
            };
        }
        if start < end {
            self.out.extend_from_slice(b"\no\n");
        }
        self.closing = Some(end);
    }
}

impl<R: BufRead> BufRead for Feed<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.taken == self.out.len()
            && let Err(failure) = self.advance()
        {
            self.failure = Some(failure);
            return Err(ErrorKind::InvalidData.into());
        }
        Ok(&self.out[self.taken..])
    }

    fn consume(&mut self, amount: usize) {
        self.taken += amount;
    }
}

impl<R: BufRead> Read for Feed<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let amount = self.fill_buf()?.read(buffer)?;
        self.consume(amount);
        Ok(amount)
    }
}

/// Splits a line into its first word and the rest.
#[inline]
fn split_word(line: &[u8]) -> (&[u8], &[u8]) {
    let start = line.iter().position(|&b| !is_blank(b)).unwrap_or(line.len());
    let line = &line[start..];
    line.split_at(line.iter().position(|&b| is_blank(b)).unwrap_or(line.len()))
}

/// Writes a line for tobj: the keyword and the numbers that are used. Further ones are dropped: w
/// or the colour of a vertex, the depth of a texture coordinate.
#[inline]
fn cut(attribute: ObjAttribute, rest: &[u8], out: &mut Vec<u8>) -> Result<(), ObjProblem> {
    let expected = attribute.dimensions();
    let (mut found, mut end) = (0, 0);
    while found < expected {
        let Some(start) = rest[end..].iter().position(|&b| !is_blank(b)) else { break };
        end += start;
        end += rest[end..].iter().position(|&b| is_blank(b)).unwrap_or(rest.len() - end);
        found += 1;
    }
    // tobj would take some non-ASCII characters for blanks.
    if !rest[..end].is_ascii() {
        let word = rest.split(|&b| is_blank(b)).find(|word| !word.is_ascii());
        return Err(bad_number(attribute, word.unwrap_or_default()));
    }
    out.extend_from_slice(attribute.key().as_bytes());
    out.extend_from_slice(&rest[..end]);
    match (attribute, found) {
        _ if found == expected => {}
        // A one-dimensional texture coordinate.
        (ObjAttribute::Texture, 1) => out.extend_from_slice(b" 0"),
        _ => return Err(ObjProblem::TooFewNumbers { attribute, found, expected }),
    }
    out.push(b'\n');
    Ok(())
}

#[cold]
fn bad_number(attribute: ObjAttribute, word: &[u8]) -> ObjProblem {
    match excerpt(attribute.key(), word) {
        Ok(text) => ObjProblem::BadNumber { attribute, text },
        Err(problem) => problem,
    }
}
