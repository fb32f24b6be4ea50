//! Overrides: `KEY=VALUE` in TOML, put into a scene file.

use std::collections::BTreeSet;

use super::error::TextProblem;
use super::sections::{MATERIAL, SECTIONS};
use super::toml_tree::parse;
use crate::params::{Fault, Mark, Node, Problem, Value};

/// Sets a key of the document to the value in the override `text`, whose index is `source`.
///
/// Keys that the file does not have are added, and checked later by the tables' readers. But textures, materials,
/// lights and shapes have to exist, except for materials of models: [`prepare`](super::prepare) checks these when it knows what faces
/// name. A value that is a table replaces the table, with all of its keys.
pub fn apply(root: &mut Node, text: &str, source: usize, of_model: bool) -> Result<(), Fault> {
    let mark = Mark { source, offset: 0 };
    let fault = |problem| Fault::new(mark, problem);
    let Some((key, value)) = text.split_once('=') else {
        return Err(fault(TextProblem::NoAssignment));
    };
    let new = parse(text, source).map_err(|error| quoted(key, value).map_or(error, fault))?;
    if new.entries().is_empty() {
        return Err(fault(TextProblem::NoAssignment));
    }
    for (kind, node) in new.entries().iter().map(|entry| (&entry.key, &entry.node)) {
        let is_later = of_model && kind == MATERIAL.key;
        if !is_later && SECTIONS.iter().any(|s| s.is_named() && s.key() == kind) {
            let known = || root.get(kind).map_or(&[][..], Node::entries).iter().map(|e| &*e.key);
            let mut unknown: BTreeSet<&str> = node.entries().iter().map(|e| &*e.key).collect();
            for name in known() {
                unknown.remove(name);
            }
            if let Some(entry) = node.entries().iter().find(|e| unknown.contains(&*e.key)) {
                return Err(Fault { mark, problem: unknown_name(kind, &entry.key, known()) });
            }
        }
    }
    let mut depth = 0;
    let mut path = &parse(&format!("{key}=0"), source)?;
    while let [entry] = path.entries() {
        (depth, path) = (depth + 1, &entry.node);
    }
    put(root, new, depth);
    Ok(())
}

/// The problem that there is nothing of a name to override.
pub fn unknown_name<'a>(kind: &str, name: &str, known: impl Iterator<Item = &'a str>) -> Problem {
    let mut problem = Problem::unknown_name(kind, name, known);
    if let Problem::UnknownName { hint, .. } = &mut problem
        && !hint.ends_with('?')
    {
        *hint += "; --set cannot add one: write it into the scene file";
    }
    problem
}

/// A shell removes the quotes around a string. If adding them makes the override valid, suggests that.
fn quoted(key: &str, value: &str) -> Option<TextProblem> {
    let is_word = value.starts_with(|c: char| c.is_alphabetic() || "./~_".contains(c));
    let quoted = format!("{key}=\"{value}\"");
    (is_word && parse(&quoted, 0).is_ok()).then_some(TextProblem::Unquoted(quoted))
}

/// Puts what stands `depth` keys deep in `new`, which has one key on each level above, into the same place.
fn put(root: &mut Node, new: Node, depth: usize) {
    match (&mut root.value, new.value) {
        (Value::Table(old), Value::Table(new)) if depth > 0 => {
            for entry in new {
                match old.iter_mut().find(|known| known.key == entry.key) {
                    Some(known) => put(&mut known.node, entry.node, depth - 1),
                    None => old.push(entry),
                }
            }
        }
        (_, value) => *root = Node { mark: new.mark, value },
    }
}
