//! [`SeenX4`]: spherical rectangles for four reference points at a time, in f32.

use std::f32::consts::TAU;

use glam::{BVec4A, Vec2, Vec4};

use crate::geometry::angle::{angle_x4, unit_circle_x4};
use crate::geometry::four::four;

/// Least solid angle in sr for which f32 is precise enough: above it the relative error of the
/// solid angle is at most 1e-5.
const LEAST: f32 = 0.05;
/// Greatest extent of a rectangle to the side, in units of the distance of its plane: near the
/// horizon precision is lost. Within it, a rectangle subtends at most 5.6 sr.
const FARTHEST: f32 = 8.0;

/// Four lanes of [`Seen`](super::Seen), by the same formulas. Lengths are in units of the distance
/// of the plane.
#[derive(Clone, Copy)]
pub struct SeenX4 {
    x: [Vec4; 2],
    y: [Vec4; 2],
    /// The distance of the plane, in scene units.
    z: Vec4,
    /// The complex number with argument E(x₀), of any magnitude.
    left: [Vec4; 2],
    /// In sr.
    pub solid_angle: Vec4,
    /// The lanes in which f32 is precise enough. The values of other lanes must not be used.
    pub sound: BVec4A,
}

impl SeenX4 {
    /// Rectangles from `start` to `start` + `size` in a plane at the distance `z` from the
    /// reference points, which are the origins. All in scene units.
    #[inline(always)]
    pub fn new(start: [Vec4; 2], size: Vec2, z: Vec4) -> Self {
        let [x0, y0] = [start[0] / z, start[1] / z];
        let [x1, y1] = [x0 + size.x / z, y0 + size.y / z];
        let (left, right) = (strip(x0, y0, y1), strip(x1, y0, y1));
        let cross = left[0] * right[1] - left[1] * right[0];
        let angle = angle_x4([left[0] * right[0] + left[1] * right[1], cross]);
        // A negative angle stands for more than half a turn.
        let solid_angle = Vec4::select(angle.cmplt(Vec4::ZERO), angle + TAU, angle);
        let extent = x0.abs().max(x1.abs()).max(y0.abs()).max(y1.abs());
        // Rounding can make a small angle slightly negative. An angle below -LEAST is one of more
        // than half a turn.
        let sound = (angle.cmpgt(Vec4::splat(LEAST)) | angle.cmplt(Vec4::splat(-LEAST)))
            & extent.cmple(Vec4::splat(FARTHEST));
        Self { x: [x0, x1], y: [y0, y1], z, left, solid_angle, sound }
    }

    /// A point of each rectangle, as distances from its left and its lower edge.
    #[inline(always)]
    pub fn sample(&self, u: [Vec2; 4]) -> [Vec4; 2] {
        let ([x0, x1], [y0, y1]) = (self.x, self.y);
        let (u0, u1) = (Vec4::from_array(four(|i| u[i].x)), Vec4::from_array(four(|i| u[i].y)));
        // E(x), which is E(x₀) rotated by u₀ Ω.
        let [a, b] = self.left;
        let length = (a * a + b * b).sqrt();
        let [cos, sin] = unit_circle_x4(u0 * self.solid_angle / TAU);
        let e = [(cos * a - sin * b) / length, (cos * b + sin * a) / length];
        // Cosine and sine of the half angle, both times an arbitrary factor.
        let right = e[0].cmpgt(Vec4::ZERO);
        let c = Vec4::select(right, 1.0 + e[0], e[1].abs());
        let s = Vec4::select(right, e[1], (1.0 - e[0]).copysign(e[1]));
        let (r0, r1) = ((y0 * y0 + 1.0).sqrt(), (y1 * y1 + 1.0).sqrt());
        let span = across(y0, y1, r0, r1, Vec4::ONE) / (r0 * r1);
        let (sum, cosines) = (y0 / r0 + y1 / r1, 1.0 / r0 + 1.0 / r1);
        let outer = (span * c - cosines * s) * (span * c + cosines * s);
        let inner = (cosines * c - sum * s) * (cosines * c + sum * s);
        let x = 2.0 * s * c * cosines / (outer.max(Vec4::ZERO) * inner.max(Vec4::ZERO)).sqrt();
        // Rounding can lead beyond the edges.
        let x = x.max(x0).min(x1);
        let depth2 = x * x + 1.0;
        let h0 = y0 / (depth2 + y0 * y0).sqrt();
        let h1 = y1 / (depth2 + y1 * y1).sqrt();
        let h = h0 + u1 * (h1 - h0);
        let y = h * (depth2 / ((1.0 - h) * (1.0 + h))).sqrt();
        [(x - x0) * self.z, (y.max(y0).min(y1) - y0) * self.z]
    }
}

/// The complex number with argument E(x), for z = 1.
#[inline(always)]
fn strip(x: Vec4, y0: Vec4, y1: Vec4) -> [Vec4; 2] {
    let distance2 = x * x + 1.0;
    let (r0, r1) = ((distance2 + y0 * y0).sqrt(), (distance2 + y1 * y1).sqrt());
    [r0 * r1 + x * x * y0 * y1, x * across(y0, y1, r0, r1, distance2)]
}

/// y₁ r₀ - y₀ r₁ for r² = y² + `distance2`, without cancellation.
#[inline(always)]
fn across(y0: Vec4, y1: Vec4, r0: Vec4, r1: Vec4, distance2: Vec4) -> Vec4 {
    let (a, b) = (y1 * r0, y0 * r1);
    let beside = distance2 * (y1 - y0) * (y1 + y0) / (a + b);
    Vec4::select((y0 * y1).cmpgt(Vec4::ZERO), beside, a - b)
}
