//! Validation of [`TriangleMesh`], and [`MeshError`].

use glam::{Vec2, Vec3};

use super::mesh::TriangleMesh;
use crate::geometry::float::MAX_COORDINATE;

impl TriangleMesh {
    /// Validates the mesh:
    ///
    /// - `normals` and `uvs` are empty or as long as `positions`;
    /// - all numbers are finite, and positions are within ± [`MAX_COORDINATE`];
    /// - all indices are in range;
    /// - there are fewer than 2³² vertices and triangles.
    ///
    /// An empty mesh is valid. The length of normals is not checked.
    ///
    /// # Errors
    /// The first violation, in this order.
    pub fn check(&self) -> Result<(), MeshError> {
        let vertices = self.positions.len();
        for (what, found) in [("normals", self.normals.len()), ("uvs", self.uvs.len())] {
            if found != 0 && found != vertices {
                return Err(MeshError::Length { what, found, vertices });
            }
        }

        fn first_bad<T: Copy>(of: &[T], is_finite: impl Fn(T) -> bool) -> Option<(usize, T)> {
            let vertex = of.iter().position(|&x| !is_finite(x))?;
            Some((vertex, of[vertex]))
        }
        let within = |p: Vec3| p.abs().max_element() <= MAX_COORDINATE && !p.is_nan();
        if let Some((vertex, found)) = first_bad(&self.positions, within) {
            return Err(MeshError::Position { vertex, found });
        }
        if let Some((vertex, found)) = first_bad(&self.normals, Vec3::is_finite) {
            return Err(MeshError::Normal { vertex, found });
        }
        if let Some((vertex, found)) = first_bad(&self.uvs, Vec2::is_finite) {
            return Err(MeshError::Uv { vertex, found });
        }

        let in_range = |t: &[u32; 3]| t.iter().all(|&v| (v as usize) < vertices);
        if let Some(triangle) = self.indices.iter().position(|t| !in_range(t)) {
            let [a, b, c] = self.indices[triangle];
            return Err(MeshError::Index { triangle, found: a.max(b).max(c), vertices });
        }
        for (what, found) in [("vertices", vertices), ("triangles", self.indices.len())] {
            if u32::try_from(found).is_err() {
                return Err(MeshError::TooMany { what, found });
            }
        }
        Ok(())
    }
}

/// An invalid [`TriangleMesh`], found by [`TriangleMesh::check`]. Vertices and triangles are
/// numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// `normals` or `uvs` is neither empty nor as long as `positions`.
    #[error(
        "mesh has {found} {what} and {vertices} vertices, expected none or one for each vertex"
    )]
    Length {
        /// "normals" or "uvs".
        what: &'static str,
        /// Its length.
        found: usize,
        /// The number of positions.
        vertices: usize,
    },
    /// A position is NaN, infinite or beyond [`MAX_COORDINATE`].
    #[error("vertex {vertex} is at {found}, expected finite coordinates up to 1e12")]
    Position {
        /// Index of the vertex.
        vertex: usize,
        /// Its position.
        found: Vec3,
    },
    /// A normal is NaN or infinite.
    #[error("vertex {vertex} has the normal {found}, expected finite numbers")]
    Normal {
        /// Index of the vertex.
        vertex: usize,
        /// Its normal.
        found: Vec3,
    },
    /// A texture coordinate is NaN or infinite.
    #[error("vertex {vertex} has the texture coordinates {found}, expected finite numbers")]
    Uv {
        /// Index of the vertex.
        vertex: usize,
        /// Its texture coordinates.
        found: Vec2,
    },
    /// A vertex index is out of range.
    #[error(
        "triangle {triangle} refers to vertex {found}, but vertices count from 0 and there are {vertices}"
    )]
    Index {
        /// Index of the triangle.
        triangle: usize,
        /// The largest of its vertex indices.
        found: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// There are more vertices or triangles than a `u32` can count.
    #[error("mesh has {found} {what}, expected fewer than 4294967296")]
    TooMany {
        /// "vertices" or "triangles".
        what: &'static str,
        /// Their number.
        found: usize,
    },
}
