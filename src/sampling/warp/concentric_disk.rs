//! The unit disk, uniform over area, by the concentric map.
//!
//! Concentric squares become concentric circles (Shirley and Chiu 1997, "A Low Distortion Map
//! Between Disk and Square"). For (a, b) = 2u - 1, the larger of |a| and |b| is the radius, and
//! their ratio gives the angle within an eighth of a turn. The map has low distortion, so
//! stratified samples remain stratified.

use std::f32::consts::{FRAC_1_PI, FRAC_PI_4};

use glam::Vec2;

use crate::simd::{Float, eighth_turn};

/// A point of the unit disk.
#[inline]
pub fn sample(u: Vec2) -> Vec2 {
    sample_wide(u.to_array()).into()
}

/// [`sample`] in each lane.
#[inline(always)]
pub(crate) fn sample_wide<F: Float>(u: [F; 2]) -> [F; 2] {
    let (r, [x, y]) = polar(u);
    [r * x, r * y]
}

/// [`sample`] in polar form: the signed radius, and the unit vector that it multiplies.
///
/// The radius is exact for u with 24 bits, as samplers give them. It is ±1 only at the border of
/// the square.
#[inline(always)]
pub(super) fn polar<F: Float>([u0, u1]: [F; 2]) -> (F, [F; 2]) {
    let (one, two) = (F::splat(1.0), F::splat(2.0));
    let (x, y) = (two * u0 - one, two * u1 - one);
    let x_larger = x.abs().gt(y.abs());
    let r = F::select(x_larger, x, y);
    let center = r.eq(F::splat(0.0));
    let share = F::select(x_larger, y, x) / F::select(center, one, r);
    let [cos, sin] = eighth_turn(share);
    // Elsewhere φ = π/2 - π/4 (a/b): sine and cosine are exchanged.
    let along_x = x_larger | center;
    (r, [F::select(along_x, cos, sin), F::select(along_x, sin, cos)])
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
