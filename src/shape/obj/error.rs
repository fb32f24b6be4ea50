//! [`ObjError`]: why an OBJ file could not be read, and where.

use std::fmt::{self, Display, Formatter};
use std::io;

use crate::geometry::float::LARGEST_COORDINATE;

/// Why an OBJ file could not be read. Each message is one sentence that begins with the file's
/// name, and with the line where there is one: `wing.obj:12: face has 2 corners, expected ...`.
///
/// Lines count from 1 and end in LF, CR LF or a lone CR. For a line that a backslash continues,
/// the number is that of its first part.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ObjError {
    /// There is nothing at that path.
    #[error("{name}: there is no such file")]
    Missing {
        /// The file, as the caller named it.
        name: String,
    },
    /// The path leads to a directory.
    #[error("{name}: is a directory, expected an OBJ file")]
    Directory {
        /// The file, as the caller named it.
        name: String,
    },
    /// Opening or reading failed.
    #[error("{name}: cannot be read: {source}")]
    Unreadable {
        /// The file, as the caller named it.
        name: String,
        /// What the system says.
        source: io::Error,
    },
    /// The whole file holds no `f` line.
    #[error(
        "{name}: has no faces: expected at least one line such as \"f 1 2 3\", found {}",
        Count(*vertices, ObjAttribute::Vertex)
    )]
    NoFaces {
        /// The file, as the caller named it.
        name: String,
        /// How many `v` lines it holds.
        vertices: usize,
    },
    /// There is more of something than a `u32` can number.
    #[error("{name}: has more than 4294967295 {what}: split it into several meshes")]
    TooLarge {
        /// The file, as the caller named it.
        name: String,
        /// "vertices", "texture coordinates", "normals" or "triangles".
        what: &'static str,
    },
    /// One line is wrong.
    #[error("{name}:{line}: {problem}")]
    Line {
        /// The file, as the caller named it.
        name: String,
        /// The line, counted from 1.
        line: u64,
        /// What is wrong with it.
        problem: ObjProblem,
    },
}

/// What is wrong with one line of an OBJ file.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ObjProblem {
    /// The file begins with the byte order mark of UTF-16.
    #[error("text is UTF-16, expected UTF-8: save the file in that encoding")]
    Utf16,
    /// Bytes that are no text, where numbers have to stand.
    #[error("{key} line holds the byte 0x{byte:02X}, which is not UTF-8, expected numbers")]
    NotText {
        /// The keyword of the line.
        key: &'static str,
        /// The first byte that is not UTF-8.
        byte: u8,
    },
    /// A `v`, `vt` or `vn` line that ends too early.
    #[error("{} has {found} of the {expected} numbers it needs", attribute.key())]
    TooFewNumbers {
        /// What the line holds.
        attribute: ObjAttribute,
        /// How many numbers it has.
        found: usize,
        /// How many it needs.
        expected: usize,
    },
    /// A word that is not a number.
    #[error("{} has {text:?} where a number is expected", attribute.key())]
    BadNumber {
        /// What the line holds.
        attribute: ObjAttribute,
        /// The word.
        text: String,
    },
    /// A number that is NaN, infinite, or beyond what its attribute may be.
    #[error(
        "{} {index} is {}, expected {}",
        attribute.singular(),
        Tuple(&found[..attribute.dimensions()]),
        attribute.range()
    )]
    OutOfRange {
        /// What the line holds.
        attribute: ObjAttribute,
        /// Which of the file's it is, counted from 1.
        index: usize,
        /// Its numbers; a texture coordinate has two.
        found: [f32; 3],
    },
    /// A face that encloses nothing.
    #[error("face has {found} of the 3 corners it needs at least")]
    FewCorners {
        /// How many corners it has.
        found: usize,
    },
    /// A corner that cannot be read.
    #[error("face has {text:?} where a corner v, v/vt, v//vn or v/vt/vn is expected")]
    BadCorner {
        /// The corner.
        text: String,
    },
    /// The index 0.
    #[error("face refers to {} 0, but OBJ counts from 1", attribute.singular())]
    IndexZero {
        /// What the index stands for.
        attribute: ObjAttribute,
    },
    /// A positive index beyond the last one of the file.
    #[error(
        "face refers to {} {index}, but the file has {}",
        attribute.singular(),
        Count(*count, *attribute)
    )]
    BeyondEnd {
        /// What the index stands for.
        attribute: ObjAttribute,
        /// The index, as it is written.
        index: i64,
        /// How many the whole file has.
        count: usize,
    },
    /// A negative index that reaches back beyond the first one of the file.
    #[error(
        "face refers to {} {index}, but {} above it",
        attribute.singular(),
        Standing(*count, *attribute)
    )]
    BeforeStart {
        /// What the index stands for.
        attribute: ObjAttribute,
        /// The index, as it is written.
        index: i64,
        /// How many stand above the face.
        count: usize,
    },
}

/// What an OBJ file lists with a number of its own, for faces to refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObjAttribute {
    /// A position: `v`.
    Vertex,
    /// A texture coordinate: `vt`.
    Texture,
    /// A normal: `vn`.
    Normal,
}

impl ObjAttribute {
    pub(super) const ALL: [Self; 3] = [Self::Vertex, Self::Texture, Self::Normal];

    /// The word its lines begin with.
    pub(super) const fn key(self) -> &'static str {
        ["v", "vt", "vn"][self as usize]
    }

    /// How many of its numbers are used.
    pub(super) const fn dimensions(self) -> usize {
        [3, 2, 3][self as usize]
    }

    const fn singular(self) -> &'static str {
        ["vertex", "texture coordinate", "normal"][self as usize]
    }

    /// The largest magnitude of its numbers.
    pub(super) const fn limit(self) -> f32 {
        [LARGEST_COORDINATE, f32::MAX, f32::MAX][self as usize]
    }

    const fn range(self) -> &'static str {
        ["finite numbers up to 1e12", "finite numbers", "finite numbers"][self as usize]
    }

    const fn plural(self) -> &'static str {
        ["vertices", "texture coordinates", "normals"][self as usize]
    }
}

/// "no vertices", "only 1 vertex", "only 4 vertices".
struct Count(usize, ObjAttribute);

impl Display for Count {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self.0 {
            0 => write!(f, "no {}", self.1.plural()),
            1 => write!(f, "only 1 {}", self.1.singular()),
            n => write!(f, "only {n} {}", self.1.plural()),
        }
    }
}

/// [`Count`] with its verb: "only 1 vertex stands", "only 4 vertices stand".
struct Standing(usize, ObjAttribute);

impl Display for Standing {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{} {}", Count(self.0, self.1), if self.0 == 1 { "stands" } else { "stand" })
    }
}

/// "(1, NaN, 2)".
struct Tuple<'a>(&'a [f32]);

impl Display for Tuple<'_> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        for (i, x) in self.0.iter().enumerate() {
            write!(f, "{}{x}", if i == 0 { "(" } else { ", " })?;
        }
        f.write_str(")")
    }
}

/// A word of the file for a message: at most 40 characters of it. Bytes that are not UTF-8 are the
/// problem themselves; `key` says in what line.
pub(super) fn excerpt(key: &'static str, word: &[u8]) -> Result<String, ObjProblem> {
    match str::from_utf8(word) {
        Ok(text) if text.chars().count() > 40 => Ok(text.chars().take(39).chain(['…']).collect()),
        Ok(text) => Ok(text.to_owned()),
        Err(e) => Err(ObjProblem::NotText { key, byte: word[e.valid_up_to()] }),
    }
}
