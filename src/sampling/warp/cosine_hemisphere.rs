//! The hemisphere around +z, with a density proportional to cos θ.
//!
//! Malley's method (PBRT 3rd edition, section 13.6.3): points uniform on the unit disk are
//! projected up to the hemisphere. The disk's area element r dr dφ is sin θ cos θ dθ dφ, so the
//! density over solid angle is C cos θ. Its integral over the hemisphere, C π, must be 1. The polar
//! form is cos θ = √(1 - u).

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use super::concentric_disk;
use crate::geometry::four::Vec3x4;

/// A unit vector with z ≥ 0. z = 0 only for u on the border of the square.
#[inline]
pub fn sample(u: Vec2) -> Vec3 {
    let (r, direction) = concentric_disk::polar(u);
    // (1 - r)(1 + r) rather than 1 - x² - y²: it keeps the precision of grazing directions, and z
    // above 0.
    (r * direction).extend(((1.0 - r) * (1.0 + r)).sqrt())
}

/// Four lanes of [`sample`].
#[inline(always)]
pub(crate) fn sample_x4(u: [Vec2; 4]) -> Vec3x4 {
    let (r, [x, y]) = concentric_disk::polar_x4(u);
    Vec3x4 { x: r * x, y: r * y, z: ((1.0 - r) * (1.0 + r)).sqrt() }
}

/// Density over solid angle in 1/sr: cos θ / π, and 0 below the horizon.
#[inline]
pub fn pdf(cos_theta: f32) -> f32 {
    cos_theta.max(0.0) * FRAC_1_PI
}

/// The inverse of [`sample`]: the u whose image is `w`.
#[inline]
pub fn inverse(w: Vec3) -> Vec2 {
    concentric_disk::inverse(w.truncate())
}
