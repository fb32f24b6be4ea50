//! Overrides: `KEY=VALUE` in TOML, merged into a scene file.

use std::collections::{BTreeMap, BTreeSet};

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
            let known = || root.get(kind).map_or(&[][..], Node::entries).iter().map(|e| &*e.key);
            let mut unknown: BTreeSet<&str> = node.entries().iter().map(|e| &*e.key).collect();
            for name in known() {
                unknown.remove(name);
            }
            if let Some(entry) = node.entries().iter().find(|e| unknown.contains(&*e.key)) {
                let problem = Problem::unknown_name(kind, &entry.key, known());
                return Err(Fault { mark, problem });
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
            // The file's table may be large, so it is searched once for all keys of the override.
            let places = new.iter().enumerate().map(|(place, entry)| (entry.key.clone(), place));
            let places: BTreeMap<String, usize> = places.collect();
            let mut new: Vec<_> = new.into_iter().map(Some).collect();
            for known in &mut *old {
                let same = places.get(&known.key).and_then(|&place| new[place].take());
                if let Some(entry) = same {
                    merge(&mut known.node, entry.node);
                }
            }
            old.extend(new.into_iter().flatten());
        }
        (_, value) => *old = Node { mark: new.mark, value },
    }
}
