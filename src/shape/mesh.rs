//! [`TriangleMesh`]: the one kind of shape.

use glam::{Vec2, Vec3};

/// Triangles that share their vertices.
///
/// `normals` and `uvs` are either empty or as long as `positions`. A normal of zero length says that
/// its vertex has none: a triangle with such a corner is shaded with its geometric normal.
/// Indices are in range and positions are finite: [`TriangleMesh::check`] says so, and whatever
/// reads or takes in a mesh calls it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Vertex positions.
    pub positions: Vec<Vec3>,
    /// Shading normals by vertex, of unit length or zero; empty when the mesh has none.
    pub normals: Vec<Vec3>,
    /// Texture coordinates by vertex; empty when the mesh has none.
    pub uvs: Vec<Vec2>,
    /// The corners of each triangle, counter-clockwise seen from outside.
    pub indices: Vec<[u32; 3]>,
}
