//! [`Source`]: the triangles that a tree is built over.

use glam::Vec3;

use super::triangles::Triangle;
use crate::shape::TriangleMesh;

/// The triangles of all meshes, numbered one after another.
pub struct Source<'a> {
    meshes: &'a [TriangleMesh],
    /// The number of the first triangle of each mesh.
    pub firsts: Vec<u32>,
    pub count: u32,
}

impl<'a> Source<'a> {
    pub fn new(meshes: &'a [TriangleMesh]) -> Self {
        let mut count = 0;
        let mut firsts = Vec::with_capacity(meshes.len());
        for mesh in meshes {
            firsts.push(count);
            count += mesh.indices.len() as u32;
        }
        Self { meshes, firsts, count }
    }

    /// Triangles whose numbers ascend.
    pub fn triangles(&self, numbers: impl Iterator<Item = u32>) -> impl Iterator<Item = Triangle> {
        // The triangles of the mesh that the last one was in.
        let (mut mesh, mut first, mut end) = (0, 0, 0);
        numbers.map(move |number| {
            if number >= end {
                mesh = self.firsts.partition_point(|&first| first <= number) - 1;
                first = self.firsts[mesh];
                end = self.firsts.get(mesh + 1).copied().unwrap_or(self.count);
            }
            let corners: [Vec3; 3] = self.meshes[mesh].corners((number - first) as usize);
            Triangle { corners, number }
        })
    }
}
