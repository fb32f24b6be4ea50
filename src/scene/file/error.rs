//! [`SceneFileError`]: why a scene file gives no scene, and where.

use std::fmt::{self, Display, Formatter};
use std::io;
use std::path::PathBuf;

use crate::scene::{SceneError, SettingsError, ViewError};
use crate::shape::ObjError;

/// Why a scene file gives no scene. Each message is one sentence that begins with the place:
/// ``scene.toml:3:1: unknown key `fvo` in [camera]; did you mean `fov`?``
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneFileError {
    /// The file cannot be read.
    #[error("{}: {}", path.display(), unreadable(source))]
    Unreadable {
        /// The file, as the caller named it.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file can be read, but something in it is wrong.
    #[error("{place}: {problem}")]
    Wrong {
        /// Where.
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

/// Where something stands that makes up a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// In the scene file.
    File {
        /// The file, as the caller named it.
        path: PathBuf,
        /// The line, counted from 1.
        line: usize,
        /// The column in characters, counted from 1.
        column: usize,
    },
    /// In an override.
    Override {
        /// All of it.
        text: String,
    },
}

impl Display for Place {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::File { path, line, column } => write!(f, "{}:{line}:{column}", path.display()),
            Self::Override { text } if text.is_empty() => f.write_str("--set ''"),
            Self::Override { text } => write!(f, "--set {text}"),
        }
    }
}

/// What is wrong at a place of a scene file. A `hint` is the nearest known name, or all known ones,
/// or empty.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The text is not TOML.
    #[error("not valid TOML: {0}")]
    Toml(String),
    /// An override is not of the form KEY=VALUE.
    #[error("expected KEY=VALUE, as in camera.fov=40")]
    NoAssignment,
    /// The value of an override is a bare word.
    #[error("text as a value stands in quotes: --set '{0}'")]
    Unquoted(String),
    /// Nothing has this name.
    #[error("unknown key `{key}` in {table}{hint}")]
    UnknownKey {
        /// The name.
        key: String,
        /// Where it was looked for.
        table: String,
        /// What it may have been meant to be.
        hint: String,
    },
    /// Something refers to what is not there.
    #[error("the scene has no {kind} `{name}`{hint}")]
    UnknownName {
        /// "texture", "material", ...
        kind: String,
        /// The name.
        name: String,
        /// What it may have been meant to be.
        hint: String,
    },
    /// A key without a default is left out.
    #[error("{table} lacks `{key}`, expected {expected}")]
    MissingKey {
        /// Where it should stand.
        table: String,
        /// Its name.
        key: &'static str,
        /// What it should hold.
        expected: String,
    },
    /// A value of the wrong type or out of range.
    #[error("`{key}` is {found}, expected {expected}")]
    Value {
        /// The full name of its key.
        key: String,
        /// The value, shortened if it is long.
        found: String,
        /// What it should be.
        expected: String,
    },
    /// Each value is fine by itself, but they make no scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Each value is fine by itself, but they make no view.
    #[error(transparent)]
    View(#[from] ViewError),
    /// The scene cannot be sampled or lit like this.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A mesh cannot be read.
    #[error(transparent)]
    Obj(#[from] ObjError),
}
