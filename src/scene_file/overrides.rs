//! Overrides: `KEY=VALUE` in TOML, merged into a scene file.

use super::error::TextProblem;
use super::sections::SECTIONS;
use super::toml_tree::parse;
use crate::params::{Fault, Mark, Node, Problem, Value};

/// Sets a key of the document to the value in the override `text`, whose index is `source`.
///
/// Keys that the file does not have are added, and checked later by the tables' readers. But textures, materials,
/// lights and shapes have to exist.
pub fn apply(root: &mut Node, text: &str, source: usize) -> Result<(), Fault> {
    let mark = Mark { source, offset: 0 };
    let fault = |problem| Fault::new(mark, problem);
    let Some((key, value)) = text.split_once('=') else {
        return Err(fault(TextProblem::NoAssignment));
    };
    let new = parse(text, source).map_err(|error| quoted(key, value).map_or(error, fault))?;
    if !has_leaf(&new) {
        return Err(fault(TextProblem::NoAssignment));
    }
    for (kind, node) in new.entries().iter().map(|entry| (&entry.key, &entry.node)) {
        if SECTIONS.iter().any(|section| section.is_named() && section.key() == kind) {
            let known = || root.get(kind).map_or(&[][..], Node::entries).iter();
            let unknown =
                node.entries().iter().find(|entry| known().all(|known| known.key != entry.key));
            if let Some(entry) = unknown {
                let known = known().map(|known| known.key.as_str());
                return Err(Fault {
                    mark,
                    problem: Problem::unknown_name(kind, &entry.key, known),
                });
            }
        }
    }
    merge(root, new);
    Ok(())
}

/// A shell removes the quotes around a string. If adding them makes the override valid, suggests that.
fn quoted(key: &str, value: &str) -> Option<TextProblem> {
    let is_word = value.starts_with(|c: char| c.is_alphabetic() || "./~_".contains(c));
    let quoted = format!("{key}=\"{value}\"");
    (is_word && parse(&quoted, 0).is_ok()).then_some(TextProblem::Unquoted(quoted))
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
