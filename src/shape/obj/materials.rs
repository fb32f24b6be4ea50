//! [`Materials`]: collects the materials that faces name.

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;

use super::lines::is_blank;
use super::report::ObjMaterials;
use crate::file::decoded;

/// Collects `usemtl` and `mtllib` lines.
#[derive(Default)]
pub(super) struct Materials {
    found: ObjMaterials,
    indices: HashMap<String, u32>,
    /// The name that is in force, and its index once a face has it.
    current: Option<(String, Option<u32>)>,
    /// Triangles so far.
    triangles: usize,
    libraries: HashSet<String>,
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

    /// A `mtllib` line.
    pub fn library(&mut self, rest: &[u8]) {
        let name = text(rest);
        if !name.is_empty() && self.libraries.insert(name.clone()) {
            self.found.libraries.push(PathBuf::from(name));
        }
    }

    /// The mesh has so many triangles now: as many as before, if the face is no polygon.
    pub fn extend(&mut self, triangles: usize) {
        let before = std::mem::replace(&mut self.triangles, triangles);
        if before == triangles {
            return;
        }
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
            of_triangles.resize(before, ObjMaterials::NONE);
            of_triangles.resize(triangles, index);
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
    decoded(&rest[start..end])
}
