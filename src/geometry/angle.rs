//! Sine, cosine and atan2 in f32 by polynomials.
//!
//! They are faster than the system's library, and their results are the same bits on every
//! platform.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use glam::{Vec2, Vec4};

/// The unit vector (cos φ, sin φ) at φ = π/4 · `share`, for `share` in `[-1, 1]`. Absolute error of
/// each component: at most 2⁻²³.
#[inline]
pub fn eighth_turn(share: f32) -> Vec2 {
    let x = FRAC_PI_4 * share;
    let x2 = x * x;
    // Taylor series in Horner's form: the coefficients are 1/n! with alternating signs.
    let cos = 1.0 + x2 * (-0.5 + x2 * (C4 + x2 * (C6 + x2 * C8)));
    let sin = x + x * x2 * (S3 + x2 * (S5 + x2 * (S7 + x2 * S9)));
    Vec2::new(cos, sin)
}

/// Four lanes of [`eighth_turn`], equal to it in every bit: cosines, then sines.
#[inline(always)]
pub fn eighth_turn_x4(share: Vec4) -> [Vec4; 2] {
    let x = FRAC_PI_4 * share;
    let x2 = x * x;
    let cos = 1.0 + x2 * (-0.5 + x2 * (C4 + x2 * (C6 + x2 * C8)));
    let sin = x + x * x2 * (S3 + x2 * (S5 + x2 * (S7 + x2 * S9)));
    [cos, sin]
}

const C4: f32 = 1.0 / 24.0;
const C6: f32 = -1.0 / 720.0;
const C8: f32 = 1.0 / 40_320.0;
const S3: f32 = -1.0 / 6.0;
const S5: f32 = 1.0 / 120.0;
const S7: f32 = -1.0 / 5_040.0;
const S9: f32 = 1.0 / 362_880.0;

/// The unit vector (cos φ, sin φ) at φ = 2π · `turn`, for `turn` in `[0, 1]`. Absolute error of
/// each component: at most 2⁻²³.
#[inline]
pub fn unit_circle(turn: f32) -> Vec2 {
    let [cos, sin] = unit_circle_x4(Vec4::splat(turn));
    Vec2::new(cos.x, sin.x)
}

/// Four lanes of [`unit_circle`]: cosines, then sines.
#[inline(always)]
pub fn unit_circle_x4(turn: Vec4) -> [Vec4; 2] {
    // Range reduction to an eighth of a turn on either side of the nearest quarter turn. The
    // subtraction is exact.
    let quarter = (4.0 * turn + 0.5).floor();
    let [cos, sin] = eighth_turn_x4(2.0 * (4.0 * turn - quarter));
    let is = |number: f32| quarter.cmpeq(Vec4::splat(number));
    let swap = is(1.0) | is(3.0);
    let (x, y) = (Vec4::select(swap, sin, cos), Vec4::select(swap, cos, sin));
    let left = is(1.0) | is(2.0);
    let below = is(2.0) | is(3.0);
    [Vec4::select(left, -x, x), Vec4::select(below, -y, y)]
}

/// Four lanes of atan2(y, x): the angle from (1, 0) to (x, y) in radians, in `[-π, π]`.
///
/// Absolute error at most 3e-7, relative error at most 3e-7. Undefined for (0, 0).
#[inline(always)]
pub fn angle_x4([x, y]: [Vec4; 2]) -> Vec4 {
    let (across, along) = (x.abs(), y.abs());
    let steep = along.cmpgt(across);
    let tangent = Vec4::select(steep, across, along) / Vec4::select(steep, along, across);
    // Range reduction: tan(φ - π/4) = (t - 1)/(t + 1), used where it is the smaller one.
    let far = tangent.cmpgt(Vec4::splat(TAN_PI_8));
    let t = Vec4::select(far, (tangent - 1.0) / (tangent + 1.0), tangent);
    let t2 = t * t;
    let series = t2 * (T7 + t2 * (T9 + t2 * (T11 + t2 * (T13 + t2 * T15))));
    let angle = t + t * t2 * (T3 + t2 * (T5 + series));
    let angle = Vec4::select(far, FRAC_PI_4 + angle, angle);
    let angle = Vec4::select(steep, FRAC_PI_2 - angle, angle);
    let angle = Vec4::select(x.cmplt(Vec4::ZERO), PI - angle, angle);
    angle.copysign(y)
}

const TAN_PI_8: f32 = std::f32::consts::SQRT_2 - 1.0;
const T3: f32 = -1.0 / 3.0;
const T5: f32 = 1.0 / 5.0;
const T7: f32 = -1.0 / 7.0;
const T9: f32 = 1.0 / 9.0;
const T11: f32 = -1.0 / 11.0;
const T13: f32 = 1.0 / 13.0;
const T15: f32 = -1.0 / 15.0;

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use glam::DVec2;

    use super::*;

    /// Compared with f64 at 2^20 + 1 turns from 0 to 1.
    #[test]
    fn unit_circle_is_exact_to_rounding() {
        for i in 0..=1 << 20 {
            let turn = i as f32 / (1 << 20) as f32;
            let error = unit_circle(turn).as_dvec2() - DVec2::from_angle(TAU * f64::from(turn));
            let error = error.abs().max_element();
            assert!(error <= f64::from(f32::EPSILON), "{turn}: error {error}");
        }
    }

    /// Compared with f64 for vectors of 2^20 directions and 20 lengths.
    #[test]
    fn angles_are_exact_to_rounding() {
        for i in -(1 << 19)..1 << 19 {
            let length = 10.0_f64.powi(i % 20);
            let v = (length * DVec2::from_angle(TAU * f64::from(i) / f64::from(1 << 20))).as_vec2();
            let [x, y] = [v.x, v.y].map(f64::from);
            let found = f64::from(angle_x4([Vec4::splat(v.x), Vec4::splat(v.y)]).x);
            let truth = y.atan2(x);
            let error = (found - truth).abs();
            assert!(error <= 3e-7_f64.min(3e-7 * truth.abs()), "{v}: {found}, expected {truth}");
        }
    }
}
