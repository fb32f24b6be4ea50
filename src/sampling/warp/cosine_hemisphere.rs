//! The hemisphere around +z, with a density proportional to cos θ.
//!
//! Malley's method (PBRT 3rd edition, section 13.6.3): points uniform on the unit disk are
//! projected up to the hemisphere. The disk's area element r dr dφ is sin θ cos θ dθ dφ, so the
//! density over solid angle is C cos θ. Its integral over the hemisphere, C π, must be 1. The polar
//! form is cos θ = √(1 - u).

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use super::concentric_disk;
use crate::geometry::Xyz;
use crate::simd::Float;

/// A unit vector with z ≥ 0. z = 0 only for u on the border of the square.
#[inline]
pub fn sample(u: Vec2) -> Vec3 {
    sample_wide(u.to_array()).into()
}

/// [`sample`] in each lane.
#[inline(always)]
pub(crate) fn sample_wide<F: Float>(u: [F; 2]) -> Xyz<F> {
    let (r, [x, y]) = concentric_disk::polar(u);
    // (1 - r)(1 + r) rather than 1 - x² - y²: it keeps the precision of grazing directions, and z
    // above 0.
    let one = F::splat(1.0);
    Xyz { x: r * x, y: r * y, z: ((one - r) * (one + r)).sqrt() }
}

/// Density over solid angle in 1/sr: cos θ / π, and 0 below the horizon.
#[inline]
pub fn pdf(cos_theta: f32) -> f32 {
    pdf_wide(cos_theta)
}

/// [`pdf`] in each lane.
#[inline(always)]
pub(crate) fn pdf_wide<F: Float>(cos_theta: F) -> F {
    cos_theta.max(F::splat(0.0)) * F::splat(FRAC_1_PI)
}

/// The inverse of [`sample`]: the u whose image is `w`.
#[inline]
pub fn inverse(w: Vec3) -> Vec2 {
    concentric_disk::inverse(w.truncate())
}
