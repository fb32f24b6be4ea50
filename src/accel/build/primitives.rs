//! [`Primitives`]: the triangles that a tree is built over.

use glam::Vec3;

use crate::accel::tree::Triangle;
use crate::shape::TriangleMesh;

/// The triangles of all meshes. Their ids count them through, mesh after mesh.
pub struct Primitives<'a> {
    meshes: &'a [&'a TriangleMesh],
    /// For each mesh the id of its first triangle.
    pub first_ids: Vec<u32>,
    pub count: u32,
}

impl<'a> Primitives<'a> {
    pub fn new(meshes: &'a [&'a TriangleMesh]) -> Self {
        let mut count = 0;
        let mut first_ids = Vec::with_capacity(meshes.len());
        for mesh in meshes {
            first_ids.push(count);
            count += mesh.indices.len() as u32;
        }
        Self { meshes, first_ids, count }
    }

    /// The triangles of ascending ids.
    pub fn triangles(&self, ids: impl Iterator<Item = u32>) -> impl Iterator<Item = Triangle> {
        // The mesh of the previous triangle, and its range of ids.
        let (mut mesh, mut first, mut end) = (0, 0, 0);
        ids.map(move |id| {
            if id >= end {
                mesh = self.first_ids.partition_point(|&first| first <= id) - 1;
                first = self.first_ids[mesh];
                end = self.first_ids.get(mesh + 1).copied().unwrap_or(self.count);
            }
            let corners: [Vec3; 3] = self.meshes[mesh].corners((id - first) as usize);
            Triangle { corners, id }
        })
    }
}
