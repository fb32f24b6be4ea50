//! [`Hit`]: where a ray meets a surface first.

use bytemuck::{Pod, Zeroable};

/// Where a ray meets a triangle first. Everything else about the hit is computed from it on demand.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Hit {
    /// Distance in multiples of the length of the ray's direction; infinite if the ray misses.
    pub t: f32,
    /// Barycentric coordinates: the weight of each corner of the triangle.
    pub b: [f32; 3],
    /// Index of the mesh, among those that the tree was built from; on an instance its index behind all meshes.
    /// [`Scene::shape_of`](crate::Scene::shape_of) tells both.
    pub shape: u32,
    /// Index of the triangle in that mesh.
    pub triangle: u32,
}

impl Hit {
    /// What a ray gets that hits nothing.
    pub const MISS: Self =
        Self { t: f32::INFINITY, b: [0.0; 3], shape: u32::MAX, triangle: u32::MAX };

    /// t and the barycentric coordinates.
    #[inline(always)]
    pub(super) fn t_and_b(&self) -> &[f32; 4] {
        // The words of shape and triangle have no meaning as numbers, and are left out.
        bytemuck::cast_ref::<Self, [f32; 6]>(self).first_chunk().expect("more than four words")
    }

    /// Whether the ray hit something.
    #[inline]
    pub fn is_hit(&self) -> bool {
        self.shape != u32::MAX
    }
}
