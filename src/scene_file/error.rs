//! [`SceneFileError`]: why a scene file cannot be read, and where.

use std::fmt::{self, Display, Formatter};
use std::io;
use std::path::PathBuf;

use crate::params::{Problem, Shown};
use crate::shape::ObjError;

/// Why a scene file cannot be read. Each message is one sentence that begins with the position:
/// ``scene.toml:3:1: unknown key `fvo` in [camera]; did you mean `fov`?``
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneFileError {
    /// The file cannot be read.
    #[error("{}: {}", Shown::path(path), unreadable(source))]
    Unreadable {
        /// The path, as passed by the caller.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The name of a file that exists ends neither in .toml nor in .obj.
    #[error("{}: expected a scene file, .toml, or a model, .obj", Shown::path(.0))]
    Ending(PathBuf),
    /// The model cannot be read.
    #[error(transparent)]
    Model(#[from] ObjError),
    /// The file can be read, but its contents are invalid.
    #[error("{place}: {problem}")]
    Wrong {
        /// Position.
        place: Place,
        /// What is wrong there.
        problem: Problem,
    },
}

fn unreadable(source: &io::Error) -> String {
    match source.kind() {
        io::ErrorKind::NotFound => "there is no such file".into(),
        io::ErrorKind::IsADirectory => "is a directory, expected a scene file".into(),
        _ => format!("cannot be read: {source}"),
    }
}

/// A position in the texts of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// In the scene file.
    File {
        /// The path, as passed by the caller.
        path: PathBuf,
        /// The line, counted from 1.
        line: usize,
        /// The column in characters, counted from 1.
        column: usize,
    },
    /// In the scene that is made for an OBJ file alone.
    Model {
        /// The path of the OBJ file, as passed by the caller.
        path: PathBuf,
    },
    /// In an override.
    Override {
        /// The whole override.
        text: String,
    },
}

impl Display for Place {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::File { path, line, column } => write!(f, "{}:{line}:{column}", Shown::path(path)),
            Self::Model { path } => write!(f, "scene of {}", Shown::path(path)),
            Self::Override { text } if text.is_empty() => f.write_str("--set ''"),
            Self::Override { text } => write!(f, "--set {}", Shown::line(text)),
        }
    }
}

/// An error in the text of a scene file or an override; contained in [`Problem::Other`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TextProblem {
    /// The text is not TOML.
    #[error("not valid TOML: {}", Shown::line(.0))]
    Toml(String),
    /// An override is not of the form KEY=VALUE.
    #[error("expected KEY=VALUE, as in camera.fov=40")]
    NoAssignment,
    /// The value of an override is text without quotes.
    #[error("text values need quotes: --set '{}'", Shown::line(.0))]
    Unquoted(String),
}
