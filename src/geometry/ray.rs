//! [`Ray`].

use glam::Vec3;

/// A half line, or a piece of one: the points `o + t d` for t in `[t_min, t_max]`.
///
/// `d` need not be of unit length: t is measured in its length, so that a shadow ray may run
/// from t = 0 at the surface to t = 1 at the light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Ray {
    /// Origin.
    pub o: Vec3,
    /// Where the ray begins to count, at least 0.
    pub t_min: f32,
    /// Direction, of any length but zero.
    pub d: Vec3,
    /// Where the ray ends; infinite for a half line.
    pub t_max: f32,
}

impl Ray {
    /// The half line from `o` along `d`.
    #[inline]
    pub const fn new(o: Vec3, d: Vec3) -> Self {
        Self { o, t_min: 0.0, d, t_max: f32::INFINITY }
    }

    /// The open segment from `o` to `p`: t = 1 stands for `p`, which itself is left out.
    #[inline]
    pub fn between(o: Vec3, p: Vec3) -> Self {
        Self { o, t_min: 0.0, d: p - o, t_max: super::float::ONE_MINUS_EPSILON }
    }
}
