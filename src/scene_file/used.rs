//! [`materials`] and [`textures`]: what a scene file defines, and whether anything refers to it.

use std::collections::BTreeSet;

use super::report::{FaceMaterial, NamedKind};
use super::sections::{EMISSION, MATERIAL, SHAPE, SHAPE_MATERIAL, TEXTURE};
use crate::params::{AnyKey, Node, Value};

/// The materials of a document: shapes have them, faces name them, or mixtures consist of them.
pub fn materials(root: &Node, faces: &[FaceMaterial]) -> Vec<NamedKind> {
    let is_name = |key: &str| ["first", "second"].contains(&key);
    let mut used = texts(root, MATERIAL.key, is_name);
    used.extend(texts(root, SHAPE.key, |key| key == SHAPE_MATERIAL.name()));
    used.extend(faces.iter().map(|face| face.name.as_str()));
    named(root, MATERIAL.key, &used)
}

/// The textures of a document: materials, shapes or other textures name them. A word that means something else may be taken for a name.
pub fn textures(root: &Node) -> Vec<NamedKind> {
    let is_name = |key: &str| !["type", "file"].contains(&key);
    let mut used = texts(root, MATERIAL.key, is_name);
    used.extend(texts(root, TEXTURE.key, is_name));
    used.extend(texts(root, SHAPE.key, |key| key == EMISSION.name()));
    named(root, TEXTURE.key, &used)
}

/// Values that are texts, in all tables of a section.
fn texts<'a>(root: &'a Node, section: &str, is_name: impl Fn(&str) -> bool) -> BTreeSet<&'a str> {
    let tables = root.get(section).map_or(&[][..], Node::entries).iter();
    let values = tables.flat_map(|table| table.node.entries()).filter(|entry| is_name(&entry.key));
    values.filter_map(|entry| text(&entry.node)).collect()
}

fn named(root: &Node, section: &str, used: &BTreeSet<&str>) -> Vec<NamedKind> {
    let tables = root.get(section).map_or(&[][..], Node::entries).iter();
    let named = tables.map(|table| NamedKind {
        name: table.key.clone(),
        kind: table.node.get("type").and_then(text).unwrap_or_default().to_owned(),
        is_used: used.contains(&*table.key),
    });
    named.collect()
}

fn text(node: &Node) -> Option<&str> {
    if let Value::Text(text) = &node.value { Some(text) } else { None }
}
