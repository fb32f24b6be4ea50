//! [`ObjError`]: why an OBJ file was refused, and at which line.

use std::fmt::{self, Display, Formatter};
use std::io;

use crate::geometry::float::MAX_COORDINATE;
use crate::params::{Shown, shortened};

/// Why an OBJ file was refused. Each message is one sentence. It begins with the name of the file
/// and, where it applies, the line: `wing.obj:12: v has 2 of the 3 numbers it needs`.
///
/// Lines are counted from 1 and end in LF, CR LF or a lone CR. A line that is continued by a
/// backslash has the number of its first part.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ObjError {
    /// The file does not exist.
    #[error("{}: there is no such file", Shown::line(name))]
    Missing {
        /// The file, as the caller named it.
        name: String,
    },
    /// The path is a directory.
    #[error("{}: is a directory, expected an OBJ file", Shown::line(name))]
    Directory {
        /// The file, as the caller named it.
        name: String,
    },
    /// Opening or reading the file failed.
    #[error("{}: cannot be read: {source}", Shown::line(name))]
    Unreadable {
        /// The file, as the caller named it.
        name: String,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The file has no face of at least three corners.
    #[error(
        "{}: has no faces: expected at least one line such as \"f 1 2 3\", found {}",
        Shown::line(name),
        Count(*vertices, ObjAttribute::Vertex)
    )]
    NoFaces {
        /// The file, as the caller named it.
        name: String,
        /// Number of `v` lines in the file.
        vertices: usize,
    },
    /// There are more elements of a kind than a `u32` can index.
    #[error("{}: has more than 4294967295 {what}: split it into several meshes", Shown::line(name))]
    TooLarge {
        /// The file, as the caller named it.
        name: String,
        /// "vertices", "texture coordinates", "normals" or "triangles".
        what: &'static str,
    },
    /// A line is invalid.
    #[error("{}:{line}: {problem}", Shown::line(name))]
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
    /// A line without its comments, but with the lines that continue it, is longer than 1 MiB.
    #[error("line is longer than 1 MiB, which is the most an OBJ file may have: is it one?")]
    LongLine,
    /// A line of numbers is not UTF-8.
    #[error("{key} line holds the byte 0x{byte:02X}, which is not UTF-8, expected numbers")]
    NotText {
        /// The keyword of the line.
        key: &'static str,
        /// The first byte that is not UTF-8.
        byte: u8,
    },
    /// A `v`, `vt` or `vn` line has too few numbers.
    #[error("{} has {found} of the {expected} numbers it needs", attribute.key())]
    TooFewNumbers {
        /// The kind of line.
        attribute: ObjAttribute,
        /// How many numbers it has.
        found: usize,
        /// How many it needs.
        expected: usize,
    },
    /// A word is not a number.
    #[error("{} has {text:?} where a number is expected", attribute.key())]
    BadNumber {
        /// The kind of line.
        attribute: ObjAttribute,
        /// The word, shortened to 60 characters.
        text: String,
    },
    /// A number is NaN, infinite, or out of the range of its attribute.
    #[error(
        "{} {index} is {}, expected {}",
        attribute.singular(),
        Tuple(&found[..attribute.dimensions()]),
        attribute.range()
    )]
    OutOfRange {
        /// The kind of element.
        attribute: ObjAttribute,
        /// Index of the element in the file, counted from 1.
        index: usize,
        /// Its numbers; the third of a texture coordinate is 0 and unused.
        found: [f32; 3],
    },
    /// A corner of a face is not of the form v, v/vt, v//vn or v/vt/vn.
    #[error("face has {text:?} where a corner v, v/vt, v//vn or v/vt/vn is expected")]
    BadCorner {
        /// The corner, shortened to 60 characters.
        text: String,
    },
    /// An index is 0.
    #[error("face refers to {} 0, but OBJ counts from 1", attribute.singular())]
    IndexZero {
        /// The kind of element that is referred to.
        attribute: ObjAttribute,
    },
    /// A positive index is larger than the number of elements in the file.
    #[error(
        "face refers to {} {index}, but the file has {}",
        attribute.singular(),
        Count(*count, *attribute)
    )]
    BeyondEnd {
        /// The kind of element that is referred to.
        attribute: ObjAttribute,
        /// The index, as written.
        index: i64,
        /// Number of such elements in the file.
        count: usize,
    },
    /// A negative index refers to an element before the first one.
    #[error(
        "face refers to {} {index}, but {} above it",
        attribute.singular(),
        Standing(*count, *attribute)
    )]
    BeforeStart {
        /// The kind of element that is referred to.
        attribute: ObjAttribute,
        /// The index, as written.
        index: i64,
        /// Number of such elements above the face.
        count: usize,
    },
}

/// Why reading ended, before the error has a file name.
pub(in crate::shape) enum Failure {
    Io(io::Error),
    Line(u64, ObjProblem),
    NoFaces(usize),
    TooMany(&'static str),
}

/// A kind of element that an OBJ file lists and that faces refer to by index.
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

    /// The keyword of its lines.
    pub(super) const fn key(self) -> &'static str {
        ["v", "vt", "vn"][self as usize]
    }

    /// How many of its numbers are read.
    pub(super) const fn dimensions(self) -> usize {
        [3, 2, 3][self as usize]
    }

    const fn singular(self) -> &'static str {
        ["vertex", "texture coordinate", "normal"][self as usize]
    }

    /// Greatest magnitude of its numbers.
    pub(super) const fn limit(self) -> f32 {
        [MAX_COORDINATE, f32::MAX, f32::MAX][self as usize]
    }

    const fn range(self) -> &'static str {
        ["finite numbers up to 1e12", "finite numbers", "finite numbers"][self as usize]
    }

    const fn plural(self) -> &'static str {
        ["vertices", "texture coordinates", "normals"][self as usize]
    }
}

/// Formats a count: "no vertices", "only 1 vertex", "only 4 vertices".
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

/// Formats a [`Count`] with a verb: "only 1 vertex stands", "only 4 vertices stand".
struct Standing(usize, ObjAttribute);

impl Display for Standing {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{} {}", Count(self.0, self.1), if self.0 == 1 { "stands" } else { "stand" })
    }
}

/// Formats a tuple: "(1, NaN, 2)".
struct Tuple<'a>(&'a [f32]);

impl Display for Tuple<'_> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        for (i, x) in self.0.iter().enumerate() {
            write!(f, "{}{x}", if i == 0 { "(" } else { ", " })?;
        }
        f.write_str(")")
    }
}

/// A word of the file for a message, shortened to 60 characters. If it is not UTF-8, that is the
/// error: [`ObjProblem::NotText`], for a line with the keyword `key`.
pub(super) fn excerpt(key: &'static str, word: &[u8]) -> Result<String, ObjProblem> {
    match str::from_utf8(word) {
        Ok(text) => Ok(shortened(text).into_owned()),
        Err(e) => Err(ObjProblem::NotText { key, byte: word[e.valid_up_to()] }),
    }
}
