//! [`PlacedMesh`]: a mesh, and where it stands.

use glam::{Vec2, Vec3};

use super::mesh::{TriangleMesh, normal_partials, position_partials};
use super::placement::Placement;

/// A mesh, and where it stands if that is not where its positions are. It gives the numbers of the mesh that
/// [`TriangleMesh::transform`] makes of it.
#[derive(Clone, Copy)]
pub(crate) struct PlacedMesh<'a> {
    mesh: &'a TriangleMesh,
    placement: Option<&'a Placement>,
}

impl<'a> PlacedMesh<'a> {
    #[inline]
    pub fn new(mesh: &'a TriangleMesh, placement: Option<&'a Placement>) -> Self {
        Self { mesh, placement }
    }

    #[inline]
    pub fn corners(self, triangle: usize) -> [Vec3; 3] {
        let corners = self.mesh.corners(triangle);
        match self.placement {
            Some(placement) => placement.order(corners.map(|p| placement.point(p))),
            None => corners,
        }
    }

    /// `None` if the mesh has none.
    #[inline]
    pub fn corner_normals(self, triangle: usize) -> Option<[Vec3; 3]> {
        let normals = self.mesh.corner_normals(triangle)?;
        Some(match self.placement {
            Some(placement) => placement.order(normals.map(|n| placement.normal(n))),
            None => normals,
        })
    }

    #[inline]
    pub fn corner_uvs(self, triangle: usize) -> [Vec2; 3] {
        let uvs = self.mesh.corner_uvs(triangle);
        match self.placement {
            // Those of a mesh without any belong to the order of its corners.
            Some(placement) if !self.mesh.uvs.is_empty() => placement.order(uvs),
            _ => uvs,
        }
    }

    /// [`TriangleMesh::position_partials`].
    pub fn position_partials(self, triangle: usize) -> [Vec3; 2] {
        position_partials(self.corners(triangle), self.corner_uvs(triangle))
    }

    /// [`TriangleMesh::normal_partials`].
    pub fn normal_partials(self, triangle: usize) -> [Vec3; 2] {
        normal_partials(self.corner_normals(triangle), self.corner_uvs(triangle))
    }
}
