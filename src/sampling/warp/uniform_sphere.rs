//! The unit sphere, uniform over solid angle.
//!
//! As on the hemisphere z is uniform: z = 1 - 2 u₀ and φ = 2π u₁ (PBRT 3rd edition, section
//! 13.6.1).

use std::f32::consts::TAU;

use glam::{Vec2, Vec3, Vec4};

use super::turn::turn;
use crate::geometry::angle::{unit_circle, unit_circle_x4};
use crate::geometry::four::{Vec3x4, four};

/// A unit vector.
#[inline]
pub fn sample(u: Vec2) -> Vec3 {
    // sin θ = √(1 - z²) = 2 √(u₀ (1 - u₀)), which keeps its precision at both poles.
    let sin_theta = 2.0 * (u.x * (1.0 - u.x)).sqrt();
    (sin_theta * unit_circle(u.y)).extend(1.0 - 2.0 * u.x)
}

/// Four lanes of [`sample`], equal to it in every bit.
#[inline(always)]
pub(crate) fn sample_x4(u: [Vec2; 4]) -> Vec3x4 {
    let (u0, u1) = (Vec4::from_array(four(|i| u[i].x)), Vec4::from_array(four(|i| u[i].y)));
    let sin_theta = 2.0 * (u0 * (1.0 - u0)).sqrt();
    let [cos, sin] = unit_circle_x4(u1);
    Vec3x4 { x: sin_theta * cos, y: sin_theta * sin, z: 1.0 - 2.0 * u0 }
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
