//! [`Fault`] and [`Problem`]: what is wrong with a value, and where.

use std::error::Error;

use super::hint::hint;
use super::tree::Mark;

/// A problem and its place. The message is that of the problem: whoever knows the text behind a [`Mark`] can say
/// more.
#[derive(Debug, thiserror::Error)]
#[error("{problem}")]
pub struct Fault {
    /// Where.
    pub mark: Mark,
    /// What is wrong there.
    pub problem: Problem,
}

/// What is wrong at a place of a document. A `hint` is the nearest known name, or all known ones, or empty.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
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
    /// A key that is known, but means nothing beside the others of its table.
    #[error("`{key}` has no effect here")]
    Unused {
        /// Its full name.
        key: String,
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
    /// A mistake in the program: a kind reads a key that is not in [`Kind::keys`](super::Kind::keys).
    #[error("{table} is read by a kind that does not declare its key `{key}`")]
    Undeclared {
        /// The key's name.
        key: &'static str,
        /// Where it was to be read.
        table: String,
    },
    /// Each value is fine by itself, but what they are for cannot be made from them.
    #[error(transparent)]
    Other(Box<dyn Error + Send + Sync>),
}

impl Fault {
    /// What a kind finds wrong with a value at this place.
    pub fn new(mark: Mark, problem: impl Error + Send + Sync + 'static) -> Self {
        Self { mark, problem: Problem::Other(Box::new(problem)) }
    }
}

impl Problem {
    /// A reference to something that is not there: `known` are the names that are.
    pub fn unknown_name<'a>(kind: &str, name: &str, known: impl Iterator<Item = &'a str>) -> Self {
        let hint = hint(name, known);
        Self::UnknownName { kind: kind.into(), name: name.escape_debug().to_string(), hint }
    }
}
