//! Rectangles and other parallelograms, as meshes.

use glam::{Vec2, Vec3};

use super::{Load, ObjMesh, Read, TriangleMesh};
use crate::params::{Fault, Key, Kind, Table};

impl TriangleMesh {
    /// The parallelogram with these edges from a corner; its outside is where `edge_u` × `edge_v` points. Texture
    /// coordinates u and v run from 0 to 1 along the edges.
    pub fn parallelogram(corner: Vec3, edge_u: Vec3, edge_v: Vec3) -> Self {
        Self {
            positions: vec![corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v],
            normals: Vec::new(),
            uvs: vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y],
            indices: vec![[0, 1, 2], [0, 2, 3]],
        }
    }
}

const CORNER: Key<Vec3> = Key::new("corner", "one of its corners");
const EDGES: Key<[Vec3; 2]> = Key::new(
    "edges",
    "the edges from there, along which u and v run from 0 to 1; their cross product points outside",
);

/// `type = "rectangle"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "rectangle",
    meaning: "A rectangle or another parallelogram",
    keys: &[&CORNER, &EDGES],
    read,
};

fn read(table: &Table) -> Result<Load, Fault> {
    let corner = table.get(&CORNER)?;
    let [u, v] = table.get(&EDGES)?;
    Ok(Box::new(move || {
        let mesh = TriangleMesh::parallelogram(corner, u, v);
        Ok(ObjMesh { mesh, ..ObjMesh::default() })
    }))
}
