//! Sine, cosine and atan2 in f32 by polynomials.
//!
//! They are faster than the system's library, and their results are the same bits on every
//! platform.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, SQRT_2};

use super::float::Float;

/// (cos φ, sin φ) at φ = π/4 · `share`, for `share` in `[-1, 1]`. Absolute error of each: at most
/// 2⁻²³.
#[inline(always)]
pub fn eighth_turn<F: Float>(share: F) -> [F; 2] {
    let c = F::constant;
    let x = c(FRAC_PI_4) * share;
    let x2 = x * x;
    // Taylor series in Horner's form: the coefficients are 1/n! with alternating signs.
    let [c4, c6, c8] = [c(1.0 / 24.0), c(-1.0 / 720.0), c(1.0 / 40_320.0)];
    let cos = c(1.0) + x2 * (c(-0.5) + x2 * (c4 + x2 * (c6 + x2 * c8)));
    let [s3, s5, s7, s9] = [c(-1.0 / 6.0), c(1.0 / 120.0), c(-1.0 / 5_040.0), c(1.0 / 362_880.0)];
    let sin = x + x * x2 * (s3 + x2 * (s5 + x2 * (s7 + x2 * s9)));
    [cos, sin]
}

/// (cos φ, sin φ) at φ = 2π · `turn`, for `turn` in `[0, 1]`. Absolute error of each: at most 2⁻²³.
#[inline(always)]
pub fn unit_circle<F: Float>(turn: F) -> [F; 2] {
    // Range reduction to an eighth of a turn on either side of the nearest quarter turn. The
    // subtraction is exact.
    let turns = F::splat(4.0) * turn;
    let quarter = (turns + F::splat(0.5)).floor();
    let [cos, sin] = eighth_turn(F::splat(2.0) * (turns - quarter));
    let [one, two, three] =
        [quarter.eq(F::splat(1.0)), quarter.eq(F::splat(2.0)), quarter.eq(F::splat(3.0))];
    let swap = one | three;
    let (x, y) = (F::select(swap, sin, cos), F::select(swap, cos, sin));
    [F::select(one | two, -x, x), F::select(two | three, -y, y)]
}

/// The angle from (1, 0) to (x, y) in radians, in `[-π, π]`.
///
/// Absolute error at most 3e-7, relative error at most 3e-7. Unspecified for (0, 0).
#[inline(always)]
pub fn atan2<F: Float>(y: F, x: F) -> F {
    let c = F::constant;
    let (across, along) = (x.abs(), y.abs());
    let steep = along.gt(across);
    let tangent = F::select(steep, across, along) / F::select(steep, along, across);
    // Range reduction: tan(φ - π/4) = (t - 1)/(t + 1), used where it is the smaller one.
    let far = tangent.gt(c(SQRT_2 - 1.0));
    let t = F::select(far, (tangent - c(1.0)) / (tangent + c(1.0)), tangent);
    let t2 = t * t;
    let [t3, t5, t7, t9] = [c(-1.0 / 3.0), c(1.0 / 5.0), c(-1.0 / 7.0), c(1.0 / 9.0)];
    let [t11, t13, t15] = [c(-1.0 / 11.0), c(1.0 / 13.0), c(-1.0 / 15.0)];
    let series = t2 * (t7 + t2 * (t9 + t2 * (t11 + t2 * (t13 + t2 * t15))));
    let angle = t + t * t2 * (t3 + t2 * (t5 + series));
    let angle = F::select(far, c(FRAC_PI_4) + angle, angle);
    let angle = F::select(steep, c(FRAC_PI_2) - angle, angle);
    let angle = F::select(x.lt(c(0.0)), c(PI) - angle, angle);
    angle.copysign(y)
}

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
            let error = DVec2::from(unit_circle(turn).map(f64::from))
                - DVec2::from_angle(TAU * f64::from(turn));
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
            let found = f64::from(atan2(v.y, v.x));
            let truth = y.atan2(x);
            let error = (found - truth).abs();
            assert!(error <= 3e-7_f64.min(3e-7 * truth.abs()), "{v}: {found}, expected {truth}");
        }
    }
}
