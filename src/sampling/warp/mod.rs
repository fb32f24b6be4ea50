//! Warps of the unit square, each with the same three functions: `sample` takes u in
//! `[0, 1)²` to the domain, `pdf` is the density of what comes out, and `inverse` leads back to u. They are functions
//! of a module (with `_x4` behind the name: for four at a time), or methods where a domain has to be prepared.
//!
//! All follow from the same recipe (PBRT 3rd edition, section 13.6): write the density in polar or
//! spherical coordinates, find the marginal of the first and the conditional of the second, and set
//! each cumulative distribution equal to one component of u.

pub mod concentric_disk;
pub mod cosine_hemisphere;
mod seen_x4;
mod spherical_rectangle;
pub mod uniform_cone;
pub mod uniform_disk;
pub mod uniform_hemisphere;
pub mod uniform_sphere;
pub mod uniform_triangle;

pub(crate) use seen_x4::SeenX4;
pub use spherical_rectangle::SphericalRectangle;
pub(crate) use spherical_rectangle::{LEAST_SOLID_ANGLE, Seen};

use std::f32::consts::TAU;

/// The share of a full turn at which (x, y) stands, in `[0, 1)`.
fn turn(x: f32, y: f32) -> f32 {
    let share = y.atan2(x) / TAU;
    let turn = if share < 0.0 { share + 1.0 } else { share };
    turn.min(crate::geometry::float::ONE_MINUS_EPSILON)
}
