//! [`BoundedPoint`]: a point on a surface with bounds on its rounding error.

use glam::Vec3;

use super::float::gamma;

/// A computed point with a conservative bound on its absolute error per axis: the exact point lies
/// in the box `p ± error`.
///
/// With it, a ray can start just outside the surface without an epsilon that depends on the scale
/// of the scene (PBRT 3rd edition, sections 3.9.4 and 3.9.5).
///
/// ```
/// use lobe::geometry::BoundedPoint;
/// use lobe::glam::{Vec3, vec3};
///
/// let corners = [vec3(0.0, 0.0, 5.0), vec3(1.0, 0.0, 5.0), vec3(0.0, 1.0, 5.0)];
/// let hit = BoundedPoint::on_triangle(corners, [0.25, 0.25, 0.5]);
/// assert_eq!(hit.p, vec3(0.25, 0.5, 5.0));
///
/// // A ray that leaves upwards starts above the plane z = 5, but by less than 1e-5.
/// let o = hit.ray_origin(Vec3::Z, Vec3::Z);
/// assert!(o.z > 5.0 && o.z < 5.00001);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundedPoint {
    /// The computed point, in scene units.
    pub p: Vec3,
    /// Bound on the absolute error along each axis, in scene units, never negative.
    pub error: Vec3,
}

impl BoundedPoint {
    /// The point of a triangle with barycentric weights `b`, which sum to 1.
    ///
    /// Each coordinate is a sum of three products. With weights that are rounded themselves, its
    /// error is at most γ₇ times the sum of the products' magnitudes (PBRT 3rd edition, section
    /// 3.9.4; γ is [`gamma`]).
    #[inline]
    pub fn on_triangle(corners: [Vec3; 3], b: [f32; 3]) -> Self {
        let [p0, p1, p2] = corners;
        let (w0, w1, w2) = (b[0] * p0, b[1] * p1, b[2] * p2);
        Self { p: w0 + w1 + w2, error: gamma(7) * (w0.abs() + w1.abs() + w2.abs()) }
    }

    /// The origin of a ray that leaves along `w` from a surface with unit normal `n`.
    ///
    /// The point is offset along the normal, to the side that `w` points to, by the smallest
    /// distance that clears the error box (PBRT 3rd edition, section 3.9.5).
    #[inline]
    pub fn ray_origin(&self, n: Vec3, w: Vec3) -> Vec3 {
        let distance = n.abs().dot(self.error);
        let offset = if w.dot(n) < 0.0 { -distance * n } else { distance * n };
        let moved = self.p + offset;
        // The sum may have been rounded towards the surface: step to the next float away from it.
        Vec3::new(
            round_away(moved.x, offset.x),
            round_away(moved.y, offset.y),
            round_away(moved.z, offset.z),
        )
    }
}

/// The float next to `value` in the direction of the sign of `offset`; `value` itself for an offset
/// of zero.
#[inline]
fn round_away(value: f32, offset: f32) -> f32 {
    if offset > 0.0 {
        value.next_up()
    } else if offset < 0.0 {
        value.next_down()
    } else {
        value
    }
}
