//! The unit disk, uniformly, in polar coordinates.
//!
//! The density 1/π over the area is r/π over (r, φ). r has the cumulative distribution r², so
//! r = √u₀ and φ = 2π u₁ (PBRT 3rd edition, section 13.6.2).

use std::f32::consts::FRAC_1_PI;

use glam::Vec2;

use super::turn;
use crate::geometry::angle::unit_circle;

/// A point of the unit disk. [`concentric_disk`](super::concentric_disk) distorts less.
#[inline]
pub fn sample(u: Vec2) -> Vec2 {
    u.x.sqrt() * unit_circle(u.y)
}

/// Density over area, 1/π everywhere on the disk.
#[inline]
pub fn pdf() -> f32 {
    FRAC_1_PI
}

/// The u that [`sample`] takes to `p`.
#[inline]
pub fn inverse(p: Vec2) -> Vec2 {
    Vec2::new(p.length_squared(), turn(p.x, p.y))
}
