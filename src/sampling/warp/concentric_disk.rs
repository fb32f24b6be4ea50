//! The unit disk, uniform over area, by the concentric map.
//!
//! Concentric squares become concentric circles (Shirley and Chiu 1997, "A Low Distortion Map
//! Between Disk and Square"). For (a, b) = 2u - 1, the larger of |a| and |b| is the radius, and
//! their ratio gives the angle within an eighth of a turn. The map has low distortion, so
//! stratified samples remain stratified.

use std::f32::consts::{FRAC_1_PI, FRAC_PI_4};

use glam::{Vec2, Vec2Swizzles, Vec4};

use crate::geometry::angle::{eighth_turn, eighth_turn_x4};
use crate::geometry::four::four;

/// A point of the unit disk.
#[inline]
pub fn sample(u: Vec2) -> Vec2 {
    let (r, direction) = polar(u);
    r * direction
}

/// [`sample`] in polar form: the signed radius, and the unit vector that it multiplies.
///
/// The radius is exact for u with 24 bits, as samplers give them. It is ±1 only at the border of
/// the square.
#[inline]
pub(super) fn polar(u: Vec2) -> (f32, Vec2) {
    let square = 2.0 * u - Vec2::ONE;
    if square.x.abs() > square.y.abs() {
        (square.x, eighth_turn(square.y / square.x))
    } else if square.y != 0.0 {
        // φ = π/2 - π/4 (a/b): sine and cosine are exchanged.
        (square.y, eighth_turn(square.x / square.y).yx())
    } else {
        (0.0, Vec2::X)
    }
}

/// Four lanes of [`polar`].
#[inline(always)]
pub(super) fn polar_x4(u: [Vec2; 4]) -> (Vec4, [Vec4; 2]) {
    let x = 2.0 * Vec4::from_array(four(|i| u[i].x)) - Vec4::ONE;
    let y = 2.0 * Vec4::from_array(four(|i| u[i].y)) - Vec4::ONE;
    let x_larger = x.abs().cmpgt(y.abs());
    let r = Vec4::select(x_larger, x, y);
    let center = r.cmpeq(Vec4::ZERO);
    let share = Vec4::select(x_larger, y, x) / Vec4::select(center, Vec4::ONE, r);
    let [cos, sin] = eighth_turn_x4(share);
    let swap = x_larger | center;
    (r, [Vec4::select(swap, cos, sin), Vec4::select(swap, sin, cos)])
}

/// Density over area: 1/π on the disk.
#[inline]
pub fn pdf() -> f32 {
    FRAC_1_PI
}

/// The inverse of [`sample`]: the u whose image is `p`.
#[inline]
pub fn inverse(p: Vec2) -> Vec2 {
    let r = p.length();
    let square = if p.x.abs() > p.y.abs() {
        let a = r.copysign(p.x);
        Vec2::new(a, a * (p.y / p.x).atan() / FRAC_PI_4)
    } else if p.y != 0.0 {
        let b = r.copysign(p.y);
        Vec2::new(b * (p.x / p.y).atan() / FRAC_PI_4, b)
    } else {
        Vec2::ZERO
    };
    (square + Vec2::ONE) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compared with f64 over a grid of the square. Seen to fail with the last term of either
    /// series left out.
    #[test]
    fn sampling_by_series_is_exact_to_rounding() {
        let steps = 1 << 10;
        for place in 0..steps * steps {
            let u = Vec2::new((place % steps) as f32, (place / steps) as f32) / steps as f32;
            let square = 2.0 * u.as_dvec2() - 1.0;
            let quarter = std::f64::consts::FRAC_PI_4;
            let (r, phi) = match square {
                s if s.x.abs() > s.y.abs() => (s.x, quarter * (s.y / s.x)),
                s if s.y != 0.0 => (s.y, 2.0 * quarter - quarter * (s.x / s.y)),
                _ => (0.0, 0.0),
            };
            let error =
                (sample(u).as_dvec2() - r * glam::DVec2::from_angle(phi)).abs().max_element();
            assert!(error <= f64::from(f32::EPSILON), "{u}: error {error}");
        }
    }
}
