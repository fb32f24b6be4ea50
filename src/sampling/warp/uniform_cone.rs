//! A cone around +z, uniformly over its solid angle.
//!
//! The cone is given by h = 1 - cos θmax, its height above the cut, and not by cos θmax: for the cone
//! under which a distant light is seen the cosine rounds to 1, and with it the solid angle 2π h to 0.
//! [`height`] finds h from sin² θmax without that loss.
//!
//! z is uniform between 1 - h and 1, so 1 - z = u₀ h and φ = 2π u₁ (PBRT 3rd edition, section 13.6.4).

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::turn;
use crate::geometry::angle::unit_circle;

/// h = 1 - cos θ for a cone of half angle θ up to π/2, from sin² θ in `[0, 1]`.
#[inline]
pub fn height(sin2_theta_max: f32) -> f32 {
    sin2_theta_max / (1.0 + (1.0 - sin2_theta_max).max(0.0).sqrt())
}

/// A unit vector within the cone of height `h` in `(0, 2]`.
#[inline]
pub fn sample(u: Vec2, h: f32) -> Vec3 {
    let below_top = u.x * h;
    let sin_theta = (below_top * (2.0 - below_top)).max(0.0).sqrt();
    (sin_theta * unit_circle(u.y)).extend(1.0 - below_top)
}

/// Density over solid angle within the cone, 1/(2π h).
#[inline]
pub fn pdf(h: f32) -> f32 {
    1.0 / (TAU * h)
}

/// The u that [`sample`] takes to `w` with the same `h`.
#[inline]
pub fn inverse(w: Vec3, h: f32) -> Vec2 {
    // 1 - z is sin² θ / (1 + z) where z is close to 1, and as it stands where z is negative.
    let below_top = if w.z > 0.0 { w.truncate().length_squared() / (1.0 + w.z) } else { 1.0 - w.z };
    Vec2::new(below_top / h, turn(w.x, w.y))
}
