//! What a [`TriangleMesh`] promises, checked.

use glam::{Vec2, Vec3};

use super::TriangleMesh;
use crate::geometry::float::LARGEST_COORDINATE;

impl TriangleMesh {
    /// Checks what the type promises: that `normals` and `uvs` are empty or as long as `positions`,
    /// that every number is finite and positions are within [`LARGEST_COORDINATE`], that every index is in range, and that there are fewer than
    /// 2^32 vertices and triangles. A mesh without triangles passes. Whether normals have unit
    /// length is not checked.
    ///
    /// # Errors
    /// The first thing that is wrong, in the order above.
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
        let within = |p: Vec3| p.abs().max_element() <= LARGEST_COORDINATE && !p.is_nan();
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

/// What [`TriangleMesh::check`] found. Vertices and triangles count from 0.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// There are too many or too few of what comes once for each vertex.
    #[error(
        "mesh has {found} {what} and {vertices} vertices, expected none or one for each vertex"
    )]
    Length {
        /// "normals" or "uvs".
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there have to be, unless there are none.
        vertices: usize,
    },
    /// A position that is NaN, infinite or too far out.
    #[error("vertex {vertex} is at {found}, expected finite coordinates up to 1e12")]
    Position {
        /// Whose it is.
        vertex: usize,
        /// What it is.
        found: Vec3,
    },
    /// A normal that is NaN or infinite.
    #[error("vertex {vertex} has the normal {found}, expected finite numbers")]
    Normal {
        /// Whose it is.
        vertex: usize,
        /// What it is.
        found: Vec3,
    },
    /// A texture coordinate that is NaN or infinite.
    #[error("vertex {vertex} has the texture coordinates {found}, expected finite numbers")]
    Uv {
        /// Whose it is.
        vertex: usize,
        /// What it is.
        found: Vec2,
    },
    /// An index without a vertex.
    #[error(
        "triangle {triangle} refers to vertex {found}, but vertices count from 0 and there are {vertices}"
    )]
    Index {
        /// Whose it is.
        triangle: usize,
        /// The largest of its indices.
        found: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// More than a `u32` can count.
    #[error("mesh has {found} {what}, expected fewer than 4294967296")]
    TooMany {
        /// "vertices" or "triangles".
        what: &'static str,
        /// How many there are.
        found: usize,
    },
}
