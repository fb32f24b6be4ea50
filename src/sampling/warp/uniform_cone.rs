//! A cone of directions around +z, uniform over its solid angle.
//!
//! Its parameter is h = 1 - cos θmax, the height of the spherical cap, and not cos θmax. For the
//! cone that a distant light subtends, cos θmax rounds to 1, and the solid angle 2π h would be 0.
//! [`height`] computes h from sin² θmax without that cancellation.
//!
//! z is uniform in `[1 - h, 1]`: 1 - z = u₀ h and φ = 2π u₁ (PBRT 3rd edition, section 13.6.4).

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::turn::turn;
use crate::simd::Float;

/// h = 1 - cos θ for the half angle θ in `[0, π/2]`, from sin² θ in `[0, 1]`.
#[inline]
pub fn height(sin2_theta_max: f32) -> f32 {
    sin2_theta_max / (1.0 + (1.0 - sin2_theta_max).max(0.0).sqrt())
}

/// A unit vector in the cone of height `h` in `(0, 2]`.
#[inline]
pub fn sample(u: Vec2, h: f32) -> Vec3 {
    let below_top = u.x * h;
    let sin_theta = (below_top * (2.0 - below_top)).max(0.0).sqrt();
    (sin_theta * Vec2::from(u.y.unit_circle())).extend(1.0 - below_top)
}

/// Density over solid angle in 1/sr: 1/(2π h) within the cone.
#[inline]
pub fn pdf(h: f32) -> f32 {
    1.0 / (TAU * h)
}

/// The inverse of [`sample`] for the same `h`: the u whose image is `w`.
#[inline]
pub fn inverse(w: Vec3, h: f32) -> Vec2 {
    // 1 - z as sin² θ / (1 + z) near the axis, where the difference would cancel.
    let below_top = if w.z > 0.0 { w.truncate().length_squared() / (1.0 + w.z) } else { 1.0 - w.z };
    Vec2::new(below_top / h, turn(w.x, w.y))
}
