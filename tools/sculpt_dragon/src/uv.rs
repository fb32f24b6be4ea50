//! [`Uv`]: texture coordinates around the y axis.

use std::collections::HashMap;
use std::f64::consts::TAU;

use glam::DVec3;

use crate::mesh::Mesh;

/// Texture coordinates of a mesh, and which of them the corners of its triangles have.
pub struct Uv {
    /// Around the axis, and along it.
    pub coordinates: Vec<[f64; 2]>,
    /// Indices of coordinates.
    pub triangles: Vec<[u32; 3]>,
}

/// u goes once around the y axis, from 0 to 1 at -z; v is the height. Triangles across that seam have coordinates beyond 1.
pub fn around_y(mesh: &Mesh) -> Uv {
    let of = |p: &DVec3| [p.x.atan2(p.z) / TAU + 0.5, p.y];
    let mut coordinates: Vec<_> = mesh.positions.iter().map(of).collect();
    let mut beyond = HashMap::new();
    let mut corners = |triangle: &[u32; 3]| {
        let u = triangle.map(|v| coordinates[v as usize][0]);
        let is_across = u.iter().any(|&a| u.iter().any(|&b| a - b > 0.5));
        triangle.map(|vertex| {
            let [u, v] = coordinates[vertex as usize];
            if !is_across || u > 0.5 {
                return vertex;
            }
            *beyond.entry(vertex).or_insert_with(|| {
                coordinates.push([u + 1.0, v]);
                coordinates.len() as u32 - 1
            })
        })
    };
    let triangles = mesh.triangles.iter().map(&mut corners).collect();
    Uv { coordinates, triangles }
}
