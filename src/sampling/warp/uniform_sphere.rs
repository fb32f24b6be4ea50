//! The sphere, uniformly.
//!
//! As on the hemisphere, z is uniform: z = 1 - 2 u₀ and φ = 2π u₁ (PBRT 3rd edition, section 13.6.1).

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::{turn, unit_circle};

/// A unit vector.
#[inline]
pub fn sample(u: Vec2) -> Vec3 {
    // sin θ = √(1 - z²) with z put in, which keeps its digits at both poles.
    let sin_theta = 2.0 * (u.x * (1.0 - u.x)).sqrt();
    (sin_theta * unit_circle(u.y)).extend(1.0 - 2.0 * u.x)
}

/// Density over solid angle, 1/(4π) everywhere.
#[inline]
pub fn pdf() -> f32 {
    0.5 / TAU
}

/// The u that [`sample`] takes to `w`.
#[inline]
pub fn inverse(w: Vec3) -> Vec2 {
    Vec2::new((1.0 - w.z) / 2.0, turn(w.x, w.y))
}
