//! Overrides: `KEY=VALUE` in TOML, laid over a scene file.

use super::document::{Fault, parse};
use super::error::Problem;
use super::hint::hint;
use super::tree::{Mark, Node, Value};

/// The tables whose keys are names that the user gives.
pub const NAMED: [&str; 4] = ["texture", "material", "light", "shape"];

/// Replaces or adds the value that `text`, number `source`, gives to a key.
///
/// A key that is new to the file may be one with a default: whether it is known is left to those who
/// read the tree. But what has a name of the user's must be there.
pub fn apply(root: &mut Node, text: &str, source: usize) -> Result<(), Fault> {
    let fault = |problem| Fault { mark: Mark { source, offset: 0 }, problem };
    let Some((key, value)) = text.split_once('=') else {
        return Err(fault(Problem::NoAssignment));
    };
    let new = parse(text, source).map_err(|error| quoted(key, value).map_or(error, fault))?;
    if !has_leaf(&new) {
        return Err(fault(Problem::NoAssignment));
    }
    for (kind, node) in new.entries().iter().map(|entry| (&entry.key, &entry.node)) {
        if NAMED.contains(&kind.as_str()) {
            let known = || root.get(kind).map_or(&[][..], Node::entries).iter();
            let unknown =
                node.entries().iter().find(|entry| known().all(|known| known.key != entry.key));
            if let Some(entry) = unknown {
                return Err(fault(Problem::UnknownName {
                    kind: kind.clone(),
                    name: entry.key.escape_debug().to_string(),
                    hint: hint(&entry.key, known().map(|known| known.key.as_str())),
                }));
            }
        }
    }
    merge(root, new);
    Ok(())
}

/// A bare word as a value is what a shell leaves of a text in quotes: show how to write it.
fn quoted(key: &str, value: &str) -> Option<Problem> {
    let is_word = value.starts_with(|c: char| c.is_alphabetic() || "./~_".contains(c));
    let quoted = format!("{key}=\"{value}\"");
    (is_word && parse(&quoted, 0).is_ok()).then_some(Problem::Unquoted(quoted))
}

fn has_leaf(node: &Node) -> bool {
    match &node.value {
        Value::Table(table) => table.iter().any(|entry| has_leaf(&entry.node)),
        _ => true,
    }
}

/// Tables are merged key by key, anything else is replaced.
fn merge(old: &mut Node, new: Node) {
    match (&mut old.value, new.value) {
        (Value::Table(old), Value::Table(new)) => {
            for entry in new {
                match old.iter_mut().find(|known| known.key == entry.key) {
                    Some(known) => merge(&mut known.node, entry.node),
                    None => old.push(entry),
                }
            }
        }
        (_, value) => *old = Node { mark: new.mark, value },
    }
}
