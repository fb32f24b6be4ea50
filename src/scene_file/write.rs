//! [`toml`]: a document as text.

use std::fmt::Write;

use crate::params::{Entry, Node, Value};

/// The tables of a document as TOML, with a heading for each table up to two levels deep, as sections have.
pub fn toml(root: &Node) -> String {
    let mut text = String::new();
    write_table(&mut text, "", root.entries(), 2);
    text
}

/// Comments with a table for each material that faces name and the scene does not have.
pub fn replaceable(names: &[String]) -> String {
    if names.is_empty() {
        return String::new();
    }
    let table = |name: &String| format!("# [material.{}]\n# type = \"matte\"\n", key_text(name));
    let tables: Vec<String> = names.iter().map(table).collect();
    let before = "\n# Faces have these materials, of MTL files. To replace one, take away the # of its table:\n#\n";
    before.to_owned() + &tables.join("#\n")
}

/// Writes the values of a table, then its tables.
fn write_table(text: &mut String, name: &str, entries: &[Entry], levels: u32) {
    let is_table = |entry: &&Entry| levels > 0 && matches!(entry.node.value, Value::Table(_));
    let mut values = entries.iter().filter(|entry| !is_table(entry)).peekable();
    if !name.is_empty() && (values.peek().is_some() || entries.is_empty()) {
        let gap = if text.is_empty() { "" } else { "\n" };
        let _ = writeln!(text, "{gap}[{name}]");
    }
    for Entry { key, node, .. } in values {
        let _ = writeln!(text, "{} = {}", key_text(key), value_text(&node.value));
    }
    for Entry { key, node, .. } in entries.iter().filter(is_table) {
        let dot = if name.is_empty() { "" } else { "." };
        let name = format!("{name}{dot}{}", key_text(key));
        write_table(text, &name, node.entries(), levels - 1);
    }
}

fn key_text(key: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !key.is_empty() && key.chars().all(is_bare) { key.to_owned() } else { quoted(key) }
}

fn value_text(value: &Value) -> String {
    match value {
        Value::Text(text) => quoted(text),
        Value::Array(values) => {
            let values: Vec<_> = values.iter().map(|node| value_text(&node.value)).collect();
            format!("[{}]", values.join(", "))
        }
        Value::Table(entries) => {
            let entry = |Entry { key, node, .. }: &Entry| {
                format!("{} = {}", key_text(key), value_text(&node.value))
            };
            let entries: Vec<_> = entries.iter().map(entry).collect();
            format!("{{ {} }}", entries.join(", "))
        }
        Value::Boolean(_) | Value::Number(_) | Value::Date(_) => value.to_string(),
    }
}

/// A basic string of TOML.
fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(quoted, "\\u{:04X}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::toml_tree::parse;

    /// The values of a tree without their positions.
    fn shape(node: &Node) -> String {
        match &node.value {
            Value::Table(entries) => {
                entries.iter().map(|e| format!("{:?}{{{}}}", e.key, shape(&e.node))).collect()
            }
            Value::Array(values) => values.iter().map(|node| shape(node) + ",").collect(),
            value => format!("{value:?}"),
        }
    }

    /// What is written is read as the same tree.
    #[test]
    fn text_and_tree_are_one() {
        let text = "a = 1\n\n[b]\nx = [1.5, \"two\", true]\n\n[c.\"d e\"]\npath = \"q\\\"\\\\\\u001B é\"\n\
                    rotate = { axis = [0, 1, 0], degrees = 40 }\nempty = []\n\n[c.f]\n";
        let tree = parse(text, 0).unwrap();
        assert_eq!(toml(&tree), text);
        assert_eq!(shape(&parse(&toml(&tree), 0).unwrap()), shape(&tree));
    }
}
