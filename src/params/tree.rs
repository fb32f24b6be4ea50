//! [`Node`] and [`Value`]: a tree of values with their positions.

use std::fmt::{self, Display, Formatter};

/// A position: source and byte offset.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mark {
    /// Index of the source. A document may combine several texts.
    pub source: usize,
    /// Offset in bytes.
    pub offset: usize,
}

/// A value with its position.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Node {
    /// Position of its first byte.
    pub mark: Mark,
    /// The value.
    pub value: Value,
}

/// A value of any type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// True or false.
    Boolean(bool),
    /// A number in decimal, as written, so that it is rounded once, to the type that is read.
    Number(String),
    /// A string.
    Text(String),
    /// A date or time. No key accepts one.
    Date(String),
    /// An array.
    Array(Vec<Node>),
    /// A table, in the order of the text.
    Table(Vec<Entry>),
}

/// A key with its value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The key.
    pub key: String,
    /// Position of the key.
    pub mark: Mark,
    /// The value.
    pub node: Node,
}

impl Node {
    /// A table without positions, for documents made in code.
    pub fn table<'k>(entries: impl IntoIterator<Item = (&'k str, Value)>) -> Self {
        let mark = Mark::default();
        let entry = |(key, value): (&str, Value)| {
            let node = Self { mark, value };
            Entry { key: key.to_owned(), mark, node }
        };
        Self { mark, value: Value::Table(entries.into_iter().map(entry).collect()) }
    }

    /// The entries of a table; empty for other values.
    pub fn entries(&self) -> &[Entry] {
        if let Value::Table(entries) = &self.value { entries } else { &[] }
    }

    /// The value of a key, if this is a table and has it.
    pub fn get(&self, key: &str) -> Option<&Self> {
        self.entries().iter().find(|entry| entry.key == key).map(|entry| &entry.node)
    }

    /// The deepest existing node along the path `keys`.
    pub fn follow(&self, keys: &[&str]) -> &Self {
        let Some((key, rest)) = keys.split_first() else { return self };
        self.get(key).map_or(self, |node| node.follow(rest))
    }
}

impl From<bool> for Value {
    fn from(value: bool) -> Self {
        Self::Boolean(value)
    }
}

impl From<&str> for Value {
    fn from(value: &str) -> Self {
        Self::Text(value.to_owned())
    }
}

impl From<f32> for Value {
    fn from(value: f32) -> Self {
        Self::Number(value.to_string())
    }
}

impl From<u64> for Value {
    fn from(value: u64) -> Self {
        Self::Number(value.to_string())
    }
}

impl<V: Into<Value>> FromIterator<V> for Value {
    fn from_iter<I: IntoIterator<Item = V>>(values: I) -> Self {
        let node = |value: V| Node { mark: Mark::default(), value: value.into() };
        Self::Array(values.into_iter().map(node).collect())
    }
}

/// In the syntax of a scene file, except for tables.
impl Display for Value {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::Boolean(value) => write!(f, "{value}"),
            Self::Number(value) | Self::Date(value) => f.write_str(value),
            Self::Text(value) => write!(f, "{value:?}"),
            Self::Array(values) => {
                f.write_str("[")?;
                for (i, node) in values.iter().enumerate() {
                    write!(f, "{}{}", if i == 0 { "" } else { ", " }, node.value)?;
                }
                f.write_str("]")
            }
            Self::Table(_) => f.write_str("a table"),
        }
    }
}
