//! [`TriangleMesh`]: an indexed triangle mesh.

use glam::{Affine3A, Vec2, Vec3};

use super::placement::Placement;
use super::triangle::triangle_normal;
use crate::geometry::float::gamma;
use crate::geometry::{Frame, Xyz, unit_cross};
use crate::simd::Float;

/// An indexed triangle mesh.
///
/// `normals` and `uvs` are either empty or as long as `positions`. A vertex without a normal has
/// one of zero length; a triangle with such a corner is shaded with its geometric normal. Indices
/// are in range, and positions are finite. [`TriangleMesh::check`] validates all of that; readers
/// of meshes and scenes call it.
///
/// ```
/// use lobe::TriangleMesh;
/// use lobe::glam::{Vec3, vec3};
///
/// let mut mesh = TriangleMesh {
///     positions: vec![Vec3::ZERO, Vec3::X, vec3(1.0, 1.0, 0.0), Vec3::Y],
///     indices: vec![[0, 1, 2], [0, 2, 3]],
///     ..TriangleMesh::default()
/// };
/// assert_eq!(mesh.check(), Ok(()));
/// assert_eq!(mesh.geometric_normal(0), Vec3::Z);
///
/// mesh.indices.push([0, 3, 4]);
/// assert_eq!(
///     mesh.check().unwrap_err().to_string(),
///     "triangle 2 refers to vertex 4, but vertices count from 0 and there are 4"
/// );
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Vertex positions, in scene units.
    pub positions: Vec<Vec3>,
    /// Shading normal of each vertex, of unit length or zero; empty if the mesh has none.
    pub normals: Vec<Vec3>,
    /// Texture coordinates of each vertex; empty if the mesh has none.
    pub uvs: Vec<Vec2>,
    /// Vertex indices of each triangle's corners, counter-clockwise seen from outside.
    pub indices: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// The positions of a triangle's corners.
    ///
    /// # Panics
    /// If there is no such triangle, as all methods with a triangle's index do.
    #[inline]
    pub fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.indices[triangle].map(|i| self.positions[i as usize])
    }

    /// The unit geometric normal of a triangle, on the side from which its corners are
    /// counter-clockwise; zero for a degenerate triangle.
    #[inline]
    pub fn geometric_normal(&self, triangle: usize) -> Vec3 {
        triangle_normal(self.corners(triangle))
    }

    /// The shading normal at barycentric coordinates `b` of a triangle: the interpolated vertex
    /// normals, at unit length. `None` if a corner has no normal, or if they cancel.
    #[inline]
    pub fn shading_normal(&self, triangle: usize, b: [f32; 3]) -> Option<Vec3> {
        let (n, exists) = shading_normal_wide(self.corner_normals(triangle)?.map(Xyz::from), b);
        exists.then_some(n.into())
    }

    /// The texture coordinates of a triangle's corners; (0,0), (1,0), (1,1) if the mesh has none.
    #[inline]
    pub fn corner_uvs(&self, triangle: usize) -> [Vec2; 3] {
        if self.uvs.is_empty() {
            return [Vec2::ZERO, Vec2::X, Vec2::ONE];
        }
        self.indices[triangle].map(|i| self.uvs[i as usize])
    }

    /// ∂p/∂u and ∂p/∂v of a triangle, in scene units per unit of u and v.
    ///
    /// p is linear in (u, v), so the edges from the third corner give a 2 × 2 linear system (PBRT
    /// 3rd edition, section 3.6.2). If it may be singular, the result is an arbitrary pair of unit
    /// tangents.
    pub fn position_partials(&self, triangle: usize) -> [Vec3; 2] {
        position_partials(self.corners(triangle), self.corner_uvs(triangle))
    }

    /// ∂n/∂u and ∂n/∂v of a triangle's vertex normals; zero if a corner has no normal, or if the
    /// texture coordinates are degenerate.
    pub fn normal_partials(&self, triangle: usize) -> [Vec3; 2] {
        normal_partials(self.corner_normals(triangle), self.corner_uvs(triangle))
    }

    /// The mesh of some of the triangles, with the vertices that they have, in the order of their first use.
    ///
    /// # Panics
    /// If there is no such triangle.
    pub fn part(&self, triangles: &[u32]) -> Self {
        let mut new_index = vec![u32::MAX; self.positions.len()];
        let mut part = Self::default();
        for &triangle in triangles {
            let corners = self.indices[triangle as usize].map(|old| {
                let index = &mut new_index[old as usize];
                if *index == u32::MAX {
                    *index = part.positions.len() as u32;
                    part.positions.push(self.positions[old as usize]);
                    part.normals.extend(self.normals.get(old as usize));
                    part.uvs.extend(self.uvs.get(old as usize));
                }
                *index
            });
            part.indices.push(corners);
        }
        part
    }

    /// Transforms positions and normals. A transformation that mirrors also reverses the order of
    /// each triangle's corners, so that the outside stays outside.
    pub fn transform(&mut self, transform: &Affine3A) {
        let placement = Placement::new(transform);
        for p in &mut self.positions {
            *p = placement.point(*p);
        }
        for n in &mut self.normals {
            *n = placement.normal(*n);
        }
        if placement.is_mirrored {
            self.indices.iter_mut().for_each(|corners| corners.swap(1, 2));
        }
    }

    /// The normals of a triangle's corners; `None` if the mesh has none.
    #[inline]
    pub(crate) fn corner_normals(&self, triangle: usize) -> Option<[Vec3; 3]> {
        if self.normals.is_empty() {
            return None;
        }
        Some(self.indices[triangle].map(|i| self.normals[i as usize]))
    }
}

/// [`TriangleMesh::position_partials`] of these corners.
pub(super) fn position_partials([p0, p1, p2]: [Vec3; 3], uvs: [Vec2; 3]) -> [Vec3; 2] {
    let solved = solve_uv(uvs, p0 - p2, p1 - p2);
    solved.filter(|[dpdu, dpdv]| unit_cross(*dpdu, *dpdv).is_some()).unwrap_or_else(|| {
        let frame = Frame::from_normal(triangle_normal([p0, p1, p2]));
        [frame.s, frame.t]
    })
}

/// [`TriangleMesh::normal_partials`] of these normals.
pub(super) fn normal_partials(normals: Option<[Vec3; 3]>, uvs: [Vec2; 3]) -> [Vec3; 2] {
    normals
        .filter(|normals| normals.iter().all(|n| *n != Vec3::ZERO))
        .and_then(|[n0, n1, n2]| solve_uv(uvs, n0 - n2, n1 - n2))
        .unwrap_or_default()
}

/// The derivatives by u and v of a quantity that is linear over a triangle. `d02` and `d12` are its differences from the third
/// corner to the first and second. `None` if the texture coordinates are degenerate.
fn solve_uv([uv0, uv1, uv2]: [Vec2; 3], d02: Vec3, d12: Vec3) -> Option<[Vec3; 2]> {
    let (duv02, duv12) = (uv0 - uv2, uv1 - uv2);
    let (down, up) = (duv02.x * duv12.y, duv02.y * duv12.x);
    let determinant = down - up;
    // Below this bound the determinant may be all rounding error.
    if determinant.abs() <= gamma(3) * (down.abs() + up.abs()) {
        return None;
    }
    let derivatives = [
        (duv12.y * d02 - duv02.y * d12) / determinant,
        (duv02.x * d12 - duv12.x * d02) / determinant,
    ];
    derivatives.iter().all(|d| d.is_finite()).then_some(derivatives)
}

/// [`TriangleMesh::shading_normal`] from the normals of the corners, and where there is one.
#[inline(always)]
pub(crate) fn shading_normal_wide<F: Float>(
    [n0, n1, n2]: [Xyz<F>; 3],
    [b0, b1, b2]: [F; 3],
) -> (Xyz<F>, F::Mask) {
    let zero = F::splat(0.0);
    let missing = n0.is_zero() | n1.is_zero() | n2.is_zero();
    let n = n0 * b0 + n1 * b1 + n2 * b2;
    let reciprocal = F::splat(1.0) / n.length_squared().sqrt();
    let is_finite = reciprocal.gt(zero) & reciprocal.lt(F::splat(f32::INFINITY));
    (n * reciprocal, is_finite & !missing)
}
