//! [`Hit`].

/// Where a ray meets a triangle first. Everything else about the hit is found from it on demand.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Hit {
    /// Distance in lengths of the ray's direction; infinite for a ray that hits nothing.
    pub t: f32,
    /// Barycentric weights of the triangle's corners.
    pub b: [f32; 3],
    /// Which mesh of those that the tree was built from.
    pub shape: u32,
    /// Which triangle of that mesh.
    pub triangle: u32,
}

impl Hit {
    /// What a ray gets that hits nothing.
    pub const MISS: Self =
        Self { t: f32::INFINITY, b: [0.0; 3], shape: u32::MAX, triangle: u32::MAX };

    /// Whether the ray hit something.
    #[inline]
    pub fn is_hit(&self) -> bool {
        self.shape != u32::MAX
    }
}
