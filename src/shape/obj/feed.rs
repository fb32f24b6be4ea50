//! [`Feed`]: what tobj gets to read.

use std::io::{self, BufRead, ErrorKind, Read, Write};

use super::error::{ObjAttribute, ObjProblem, excerpt};
use super::faces::Faces;
use super::lines::{LogicalLines, is_blank};
use super::places::Places;

/// How many corners the faces that close the feed have, but for the last one. A few at a time: tobj
/// looks every corner up in a hash table of its object, and small ones are fast.
pub(super) const CLOSING_CORNERS: usize = 1024;

/// Stands between the file and tobj.
///
/// It passes `v`, `vt` and `vn` lines on, one at a time and cut after the numbers that count, so
/// that tobj reads the numbers. It keeps the `f` lines for itself, because each index has to be
/// checked at its own line, and because tobj numbers vertices anew by hashing every corner. It
/// drops everything else: names, materials, points, lines, curves.
///
/// tobj returns only what some face refers to, in the order of first use. So the feed ends with
/// faces of its own, each an object, that refer to everything once, in the order of the file.
pub(super) struct Feed<R> {
    lines: LogicalLines<R>,
    /// The faces of the file.
    pub faces: Faces,
    /// Where the vertices, texture coordinates and normals stand.
    pub places: [Places; 3],
    /// The line that tobj is reading, how much of it it has read, and its place in the file.
    out: Vec<u8>,
    taken: usize,
    origin: (ObjAttribute, u64),
    /// The corner with which the closing faces go on; `None` before the file's end.
    closing: Option<usize>,
    /// What stopped the feed: tobj itself keeps only that something did.
    failure: Option<Failure>,
}

/// What stopped the feed.
pub(super) enum Failure {
    Io(io::Error),
    Line(u64, ObjProblem),
    NoFaces(usize),
    TooMany(&'static str),
}

impl<R: BufRead> Feed<R> {
    pub fn new(input: R) -> Self {
        Self {
            lines: LogicalLines::new(input),
            faces: Faces::default(),
            places: Default::default(),
            out: Vec::new(),
            taken: 0,
            origin: (ObjAttribute::Vertex, 0),
            closing: None,
            failure: None,
        }
    }

    /// How many vertices, texture coordinates and normals were read.
    pub fn counts(&self) -> [usize; 3] {
        self.places.each_ref().map(Places::count)
    }

    /// Why tobj gave up: what stopped the feed, or else a bad number in the line it read last.
    pub fn into_failure(self, error: tobj::LoadError) -> Failure {
        if let Some(failure) = self.failure {
            return failure;
        }
        let (attribute, line) = self.origin;
        let is_number = |word: &str| word.parse::<f32>().is_ok();
        // What was sent is ASCII.
        let sent = str::from_utf8(&self.out).unwrap_or_default();
        match sent.split_whitespace().skip(1).find(|word| !is_number(word)) {
            Some(word) => Failure::Line(line, bad_number(attribute, word.as_bytes())),
            None => Failure::Io(io::Error::new(ErrorKind::InvalidData, error)),
        }
    }

    /// Fills `out` with the next line for tobj, or leaves it empty at the end.
    fn advance(&mut self) -> Result<(), Failure> {
        self.out.clear();
        self.taken = 0;
        while self.closing.is_none() {
            let counts = self.counts();
            let Some((number, line)) = self.lines.next().map_err(Failure::Io)? else {
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
                    continue;
                }
                _ if number == 1
                    && (word.starts_with(b"\xFF\xFE") || word.starts_with(b"\xFE\xFF")) =>
                {
                    return Err(Failure::Line(number, ObjProblem::Utf16));
                }
                _ => continue,
            };
            cut(attribute, rest, &mut self.out).map_err(|p| Failure::Line(number, p))?;
            self.places[attribute as usize].push(number);
            self.origin = (attribute, number);
            return Ok(());
        }
        self.close();
        Ok(())
    }

    /// Checks what can be checked once the whole file was read.
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

    /// Writes the next closing face: corner `i` refers to the vertex, the texture coordinate and the
    /// normal `i`, or to the last one where there are fewer.
    fn close(&mut self) {
        let [vertices, textures, normals] = self.counts();
        let start = self.closing.unwrap_or_default();
        let end = vertices.max(textures).max(normals).min(start + CLOSING_CORNERS);
        if start < end {
            self.out.push(b'f');
        }
        for i in start + 1..=end {
            let (v, vt, vn) = (i.min(vertices), i.min(textures), i.min(normals));
            // Writing to a Vec can't fail.
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

/// The first word of a line, and what follows it.
#[inline]
fn split_word(line: &[u8]) -> (&[u8], &[u8]) {
    let start = line.iter().position(|&b| !is_blank(b)).unwrap_or(line.len());
    let line = &line[start..];
    line.split_at(line.iter().position(|&b| is_blank(b)).unwrap_or(line.len()))
}

/// Writes the line for tobj: the numbers that count of the `rest` of a line, without those that may
/// follow (the w or the colour of a vertex, the depth of a texture coordinate).
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
    // Tobj would read some of what is not ASCII as blanks.
    if !rest[..end].is_ascii() {
        let word = rest.split(|&b| is_blank(b)).find(|word| !word.is_ascii());
        return Err(bad_number(attribute, word.unwrap_or_default()));
    }
    out.extend_from_slice(attribute.key().as_bytes());
    out.extend_from_slice(&rest[..end]);
    match (attribute, found) {
        _ if found == expected => {}
        // A one-dimensional texture.
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
