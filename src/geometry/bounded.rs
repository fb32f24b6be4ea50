//! [`BoundedPoint`]: a point on a surface together with the error it may have.

use glam::Vec3;

use super::float::gamma;

/// A computed point and a box around it that holds the exact one: `p ± error`, axis by axis.
///
/// It is what makes a ray's start safe without an epsilon that depends on the scene's scale
/// (PBRT 3rd edition, sections 3.9.4 and 3.9.5).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundedPoint {
    /// The computed point.
    pub p: Vec3,
    /// Bounds on its absolute error, none negative.
    pub error: Vec3,
}

impl BoundedPoint {
    /// The point of a triangle with barycentric weights `b`, which add up to 1.
    ///
    /// Each coordinate is a sum of three products, whose error stays within γ₇ times the sum of their
    /// magnitudes when the weights themselves were computed with rounding
    /// (PBRT 3rd edition, section 3.9.4).
    #[inline]
    pub fn on_triangle(corners: [Vec3; 3], b: [f32; 3]) -> Self {
        let [p0, p1, p2] = corners;
        let (w0, w1, w2) = (b[0] * p0, b[1] * p1, b[2] * p2);
        Self { p: w0 + w1 + w2, error: gamma(7) * (w0.abs() + w1.abs() + w2.abs()) }
    }

    /// The origin for a ray that leaves along `w` from a surface with unit normal `n`: moved along the
    /// normal, to the side that `w` points to, just far enough to lie outside of the error box.
    #[inline]
    pub fn ray_origin(&self, n: Vec3, w: Vec3) -> Vec3 {
        let distance = n.abs().dot(self.error);
        let offset = if w.dot(n) < 0.0 { -distance * n } else { distance * n };
        let moved = self.p + offset;
        // The sum is rounded, perhaps towards the surface: step to the next float away from it.
        Vec3::new(
            round_away(moved.x, offset.x),
            round_away(moved.y, offset.y),
            round_away(moved.z, offset.z),
        )
    }
}

/// The next float after `value` in the direction of the sign of `offset`.
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
