//! [`Materials`]: collects the materials that faces name.

use std::collections::HashMap;

use super::lines::is_blank;
use super::report::ObjMaterials;

/// Collects `usemtl` and `mtllib` lines.
#[derive(Default)]
pub(super) struct Materials {
    found: ObjMaterials,
    indices: HashMap<String, u32>,
    /// The name that is in force, and its index once a face has it.
    current: Option<(String, Option<u32>)>,
    /// Triangles above the first name.
    without: usize,
}

impl Materials {
    /// The faces that follow have the material of this `usemtl` line. Without a name they have none.
    pub fn select(&mut self, rest: &[u8]) {
        let name = text(rest);
        self.current = (!name.is_empty()).then(|| {
            let index = self.indices.get(&name).copied();
            (name, index)
        });
    }

    /// A `mtllib` line. File names with blanks are allowed, as most programs write only one.
    pub fn library(&mut self, rest: &[u8]) {
        let name = text(rest);
        if !name.is_empty() && !self.found.libraries.contains(&name) {
            self.found.libraries.push(name);
        }
    }

    /// The mesh has so many triangles now.
    pub fn extend(&mut self, triangles: usize) {
        let index = match &mut self.current {
            None => ObjMaterials::NONE,
            Some((_, Some(index))) => *index,
            Some((name, index)) => {
                let new = self.found.names.len() as u32;
                self.found.names.push(name.clone());
                self.indices.insert(name.clone(), new);
                *index.insert(new)
            }
        };
        let of_triangles = &mut self.found.of_triangles;
        if index != ObjMaterials::NONE || !of_triangles.is_empty() {
            // Those above the first name have none.
            if of_triangles.is_empty() {
                of_triangles.resize(self.without, ObjMaterials::NONE);
            }
            of_triangles.resize(triangles, index);
        } else {
            self.without = triangles;
        }
    }

    /// All that was found.
    pub fn finish(self) -> ObjMaterials {
        self.found
    }
}

/// What follows a keyword, without blanks around it.
pub(in crate::shape) fn text(rest: &[u8]) -> String {
    let is_end = |b: &u8| is_blank(*b);
    let start = rest.iter().position(|b| !is_end(b)).unwrap_or(rest.len());
    let end = rest.iter().rposition(|b| !is_end(b)).map_or(start, |last| last + 1);
    let bytes = &rest[start..end];
    match str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}
