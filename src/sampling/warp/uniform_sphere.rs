//! The unit sphere, uniform over solid angle.
//!
//! As on the hemisphere z is uniform: z = 1 - 2 u₀ and φ = 2π u₁ (PBRT 3rd edition, section
//! 13.6.1).

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::turn::turn;
use crate::geometry::Xyz;
use crate::simd::Float;

/// A unit vector.
#[inline]
pub fn sample(u: Vec2) -> Vec3 {
    sample_wide(u.to_array()).into()
}

/// [`sample`] in each lane.
#[inline(always)]
pub(crate) fn sample_wide<F: Float>([u0, u1]: [F; 2]) -> Xyz<F> {
    let (one, two) = (F::splat(1.0), F::splat(2.0));
    // sin θ = √(1 - z²) = 2 √(u₀ (1 - u₀)), which keeps its precision at both poles.
    let sin_theta = two * (u0 * (one - u0)).sqrt();
    let [cos, sin] = u1.unit_circle();
    Xyz { x: sin_theta * cos, y: sin_theta * sin, z: one - two * u0 }
}

/// Density over solid angle in 1/sr: 1/(4π).
#[inline]
pub fn pdf() -> f32 {
    0.5 / TAU
}

/// The inverse of [`sample`]: the u whose image is `w`.
#[inline]
pub fn inverse(w: Vec3) -> Vec2 {
    Vec2::new((1.0 - w.z) / 2.0, turn(w.x, w.y))
}
