//! [`Fault`] and [`Problem`]: what is wrong in a document, and where.

use std::error::Error;

use super::hint::hint;
use super::shown::Shown;
use super::tree::Mark;

/// A problem and its position. `Display` shows the problem only: a caller that has the text behind the [`Mark`] can
/// add line and column.
#[derive(Debug, thiserror::Error)]
#[error("{problem}")]
pub struct Fault {
    /// Position.
    pub mark: Mark,
    /// What is wrong there.
    pub problem: Problem,
}

/// What is wrong at a position of a document. A `hint` suggests the nearest known name, or lists all known names, or
/// is empty.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// A key that the table does not have.
    #[error("unknown key `{key}` in {table}{hint}")]
    UnknownKey {
        /// The key.
        key: String,
        /// The table, as messages call it.
        table: String,
        /// Suggestion for the message.
        hint: String,
    },
    /// A known key that has no effect beside the other keys of its table.
    #[error("`{key}` has no effect here")]
    Unused {
        /// Its full name.
        key: String,
    },
    /// A reference to something that is not defined.
    #[error("the scene has no {kind} `{name}`{hint}")]
    UnknownName {
        /// "texture", "material", ...
        kind: String,
        /// The missing name.
        name: String,
        /// Suggestion for the message.
        hint: String,
    },
    /// A required key is missing.
    #[error("{table} lacks `{key}`, expected {expected}")]
    MissingKey {
        /// The table in which it is missing.
        table: String,
        /// Its name.
        key: &'static str,
        /// Description of the values it can have.
        expected: String,
    },
    /// A value of the wrong type or out of range.
    #[error("`{key}` is {found}, expected {expected}")]
    Value {
        /// The full name of its key.
        key: String,
        /// The value, shortened if it is long.
        found: String,
        /// Description of the values it can have.
        expected: String,
    },
    /// References to what refers to others, and so on, to more than can be evaluated.
    #[error("{table} refers to {cost} evaluations at each point, above the limit of {most}")]
    Costly {
        /// The table, as messages call it.
        table: String,
        /// Number of evaluations.
        cost: u32,
        /// The limit.
        most: u32,
    },
    /// A mistake in the program: a kind reads a key that is not in [`Kind::keys`](super::Kind::keys).
    #[error("{table} is read by a kind that does not declare its key `{key}`")]
    Undeclared {
        /// The key's name.
        key: &'static str,
        /// Where it was to be read.
        table: String,
    },
    /// Each value is valid by itself, but not in combination with others or with a file.
    #[error(transparent)]
    Other(Box<dyn Error + Send + Sync>),
}

impl Fault {
    /// An error of a kind's own about the value at this position.
    pub fn new(mark: Mark, problem: impl Error + Send + Sync + 'static) -> Self {
        Self { mark, problem: Problem::Other(Box::new(problem)) }
    }
}

impl Problem {
    /// A reference to an undefined name; `known` are the defined names.
    pub fn unknown_name<'a>(kind: &str, name: &str, known: impl Iterator<Item = &'a str>) -> Self {
        let hint = hint(name, known);
        Self::UnknownName { kind: kind.into(), name: Shown::name(name).to_string(), hint }
    }
}
