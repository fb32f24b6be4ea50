//! The hemisphere around +z, uniform over solid angle.
//!
//! Uniform density over solid angle is uniform in z = cos θ (Archimedes), so z = u₀ and φ = 2π u₁
//! (PBRT 3rd edition, section 13.6.1).

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::turn::turn;
use crate::simd::Float;

/// A unit vector with z ≥ 0.
#[inline]
pub fn sample(u: Vec2) -> Vec3 {
    let z = u.x;
    (((1.0 - z) * (1.0 + z)).sqrt() * Vec2::from(u.y.unit_circle())).extend(z)
}

/// Density over solid angle in 1/sr: 1/(2π) above the horizon.
#[inline]
pub fn pdf() -> f32 {
    1.0 / TAU
}

/// The inverse of [`sample`]: the u whose image is `w`.
#[inline]
pub fn inverse(w: Vec3) -> Vec2 {
    Vec2::new(w.z, turn(w.x, w.y))
}
