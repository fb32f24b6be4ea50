//! Conversion of TOML to a tree in which every value has its position.

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::error::TextProblem;
use crate::params::{Entry, Fault, Mark, Node, Value};

/// The tree of a text, which is source number `source` of its document.
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
    // The parser sorts keys by name: restore the order of the text.
    entries.sort_by_key(|entry| entry.mark.offset);
    entries
}

fn node(value: &Spanned<DeValue>, source: usize) -> Node {
    let mark = Mark { source, offset: value.span().start };
    let value = match value.get_ref() {
        DeValue::Boolean(value) => Value::Boolean(*value),
        DeValue::Integer(value) if value.radix() == 10 => Value::Number(value.as_str().into()),
        // Integers beyond u128 stay in their notation, which no number type parses.
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
