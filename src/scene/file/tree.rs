//! The tree of a TOML text, with the place of every key and value.

use std::fmt::{self, Display, Formatter};

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

/// Where something begins: which source it belongs to, and at which byte of it.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    pub source: usize,
    pub offset: usize,
}

/// A value and where it begins.
#[derive(Clone, Debug)]
pub struct Node {
    pub mark: Mark,
    pub value: Value,
}

/// What a value can be.
#[derive(Clone, Debug)]
pub enum Value {
    Boolean(bool),
    /// In decimal, as it is written: whoever asks for it knows which type it should fill.
    Number(String),
    Text(String),
    Date(String),
    Array(Vec<Node>),
    Table(Table),
}

/// Keys and values in the order of the text.
pub type Table = Vec<Entry>;

/// A key with its value.
#[derive(Clone, Debug)]
pub struct Entry {
    pub key: String,
    /// Where the key stands.
    pub mark: Mark,
    pub node: Node,
}

impl Node {
    /// Copies a parsed text, whose number is `source`.
    pub fn from_table(table: &Spanned<DeTable>, source: usize) -> Self {
        let mark = Mark { source, offset: table.span().start };
        Self { mark, value: Value::Table(entries(table.get_ref(), source)) }
    }

    fn from_value(value: &Spanned<DeValue>, source: usize) -> Self {
        let mark = Mark { source, offset: value.span().start };
        let value = match value.get_ref() {
            DeValue::Boolean(value) => Value::Boolean(*value),
            DeValue::Integer(value) if value.radix() == 10 => Value::Number(value.as_str().into()),
            // One that does not even fit here stays as it is, which is no number to anyone.
            DeValue::Integer(value) => Value::Number(
                u128::from_str_radix(value.as_str(), value.radix())
                    .map_or(value.to_string(), |value| value.to_string()),
            ),
            DeValue::Float(value) => Value::Number(value.as_str().into()),
            DeValue::String(value) => Value::Text(value.to_string()),
            DeValue::Datetime(value) => Value::Date(value.to_string()),
            DeValue::Array(values) => {
                Value::Array(values.iter().map(|value| Self::from_value(value, source)).collect())
            }
            DeValue::Table(table) => Value::Table(entries(table, source)),
        };
        Self { mark, value }
    }

    /// The entries of a table; none if it is not one.
    pub fn entries(&self) -> &[Entry] {
        if let Value::Table(table) = &self.value { table } else { &[] }
    }

    /// The value of a key, if this is a table that has it.
    pub fn get(&self, key: &str) -> Option<&Self> {
        self.entries().iter().find(|entry| entry.key == key).map(|entry| &entry.node)
    }

    /// The deepest node on the way along `keys`, as far as there are any.
    pub fn follow(&self, keys: &[&str]) -> &Self {
        let Some((key, rest)) = keys.split_first() else { return self };
        self.get(key).map_or(self, |node| node.follow(rest))
    }
}

fn entries(table: &DeTable, source: usize) -> Table {
    let entry = |(key, value): (&Spanned<DeString>, &_)| Entry {
        key: key.get_ref().to_string(),
        mark: Mark { source, offset: key.span().start },
        node: Node::from_value(value, source),
    };
    let mut entries: Table = table.iter().map(entry).collect();
    // The parser sorts by name.
    entries.sort_by_key(|entry| entry.mark.offset);
    entries
}

/// As it could stand in a file, but without the contents of tables.
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
