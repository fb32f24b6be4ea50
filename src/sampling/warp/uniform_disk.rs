//! The unit disk, uniform over area, in polar coordinates.
//!
//! The density over area, 1/π, is r/π over (r, φ). The cumulative distribution of r is r², so r =
//! √u₀ and φ = 2π u₁ (PBRT 3rd edition, section 13.6.2).

use std::f32::consts::FRAC_1_PI;

use glam::Vec2;

use super::turn::turn;
use crate::simd::Float;

/// A point of the unit disk. [`concentric_disk`](super::concentric_disk) has less distortion.
#[inline]
pub fn sample(u: Vec2) -> Vec2 {
    u.x.sqrt() * Vec2::from(u.y.unit_circle())
}

/// Density over area: 1/π on the disk.
#[inline]
pub fn pdf() -> f32 {
    FRAC_1_PI
}

/// The inverse of [`sample`]: the u whose image is `p`.
#[inline]
pub fn inverse(p: Vec2) -> Vec2 {
    Vec2::new(p.length_squared(), turn(p.x, p.y))
}
