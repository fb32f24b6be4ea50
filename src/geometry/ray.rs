//! [`Ray`]: a half line or a segment.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// A half line or a segment: the points `o + t d` for t in `[t_min, t_max]`.
///
/// `d` need not have unit length: t is measured in lengths of `d`. So a shadow ray may run from t =
/// 0 at the surface to t = 1 at the light.
///
/// ```
/// use lobe::geometry::Ray;
/// use lobe::glam::{Vec3, vec3};
///
/// let ray = Ray::new(Vec3::ZERO, Vec3::Z);
/// assert_eq!((ray.t_min, ray.t_max), (0.0, f32::INFINITY));
///
/// // From a surface to a light: t is the fraction of the distance.
/// let shadow = Ray::between(Vec3::ZERO, vec3(0.0, 0.0, 8.0));
/// assert_eq!(shadow.o + 0.5 * shadow.d, vec3(0.0, 0.0, 4.0));
/// assert!(shadow.t_max < 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Ray {
    /// Origin, in scene units.
    pub o: Vec3,
    /// Least t of a hit, at least 0.
    pub t_min: f32,
    /// Direction, of any non-zero length.
    pub d: Vec3,
    /// Greatest t of a hit; infinite for a half line.
    pub t_max: f32,
}

impl Ray {
    /// The half line from `o` along `d`.
    #[inline]
    pub const fn new(o: Vec3, d: Vec3) -> Self {
        Self { o, t_min: 0.0, d, t_max: f32::INFINITY }
    }

    /// The segment from `o` to `p`, without `p` itself: t = 1 would be `p`, and `t_max` is the
    /// float below.
    #[inline]
    pub fn between(o: Vec3, p: Vec3) -> Self {
        Self { o, t_min: 0.0, d: p - o, t_max: super::float::ONE_MINUS_EPSILON }
    }
}
