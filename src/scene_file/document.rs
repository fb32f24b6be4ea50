//! [`Source`]: the texts of a scene, and the tree that they make together.

use std::path::{Path, PathBuf};

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::error::{Place, SceneFileError, TextProblem};
use super::overrides;
use crate::params::{Document, Entry, Fault, Mark, Node, Value};

/// The texts that make up a scene: number 0 is the file, the others are the overrides in their order.
pub struct Source<'a> {
    path: &'a Path,
    text: &'a str,
    overrides: &'a [&'a str],
}

impl<'a> Source<'a> {
    pub fn new(path: &'a Path, text: &'a str, overrides: &'a [&'a str]) -> Self {
        Self { path, text: text.strip_prefix('\u{FEFF}').unwrap_or(text), overrides }
    }

    /// Parses the file and applies the overrides to it, one after the other. Paths in the file are relative to its
    /// folder, those in overrides to the current directory.
    pub fn parse(&self) -> Result<Document, SceneFileError> {
        let mut root = self.place(parse(self.text, 0))?;
        for (i, text) in self.overrides.iter().enumerate() {
            self.place(overrides::apply(&mut root, text, i + 1))?;
        }
        let folder = self.path.parent().map_or(PathBuf::new(), Path::to_owned);
        Ok(Document { root, folders: vec![folder] })
    }

    /// Turns the mark of a fault into a place.
    pub fn place<T>(&self, result: Result<T, Fault>) -> Result<T, SceneFileError> {
        result.map_err(|Fault { mark, problem }| {
            let place = match mark.source {
                0 => file_place(self.path, self.text.as_bytes(), mark.offset),
                i => Place::Override { text: self.overrides[i - 1].to_owned() },
            };
            SceneFileError::Wrong { place, problem }
        })
    }
}

/// The tree of a text, whose number is `source`.
pub fn parse(text: &str, source: usize) -> Result<Node, Fault> {
    match DeTable::parse(text) {
        Ok(table) => {
            let mark = Mark { source, offset: table.span().start };
            Ok(Node { mark, value: Value::Table(entries(table.get_ref(), source)) })
        }
        Err(error) => {
            let offset = error.span().map_or(0, |span| span.start);
            Err(Fault::new(Mark { source, offset }, TextProblem::Toml(error.message().into())))
        }
    }
}

fn entries(table: &DeTable, source: usize) -> Vec<Entry> {
    let entry = |(key, value): (&Spanned<DeString>, &_)| Entry {
        key: key.get_ref().to_string(),
        mark: Mark { source, offset: key.span().start },
        node: node(value, source),
    };
    let mut entries: Vec<Entry> = table.iter().map(entry).collect();
    // The parser sorts by name.
    entries.sort_by_key(|entry| entry.mark.offset);
    entries
}

fn node(value: &Spanned<DeValue>, source: usize) -> Node {
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
            Value::Array(values.iter().map(|value| node(value, source)).collect())
        }
        DeValue::Table(table) => Value::Table(entries(table, source)),
    };
    Node { mark, value }
}

/// Line and column of a byte.
pub fn file_place(path: &Path, text: &[u8], offset: usize) -> Place {
    let before = &text[..offset.min(text.len())];
    let line_start = before.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
    Place::File {
        path: path.to_owned(),
        line: before.iter().filter(|&&byte| byte == b'\n').count() + 1,
        column: String::from_utf8_lossy(&before[line_start..]).chars().count() + 1,
    }
}
