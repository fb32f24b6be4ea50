//! Warps: maps from the unit square to other domains, for importance sampling.
//!
//! Each has the same three functions. `sample` takes u in `[0, 1)²` to the domain, `pdf` is the
//! probability density of the result, and `inverse` returns the u. They are functions of a module,
//! or methods of a type where the domain has parameters that need set-up. The suffix `_wide` marks
//! the formula behind it, for one number or several.
//!
//! All follow one recipe (PBRT 3rd edition, section 13.6): write the density in polar or spherical
//! coordinates, find the marginal density of the first and the conditional density of the second,
//! and set the cumulative distribution of each equal to one component of u.
//!
//! ```
//! use lobe::glam::{Vec2, vec2};
//! use lobe::sampling::cosine_hemisphere;
//!
//! let u = vec2(0.25, 0.625);
//! let w = cosine_hemisphere::sample(u);
//! assert!(w.is_normalized() && w.z > 0.0);
//! assert_eq!(cosine_hemisphere::pdf(w.z), w.z * std::f32::consts::FRAC_1_PI);
//! assert!(cosine_hemisphere::inverse(w).abs_diff_eq(u, 1e-6));
//! ```

pub mod bilinear;
pub mod concentric_disk;
pub mod cosine_hemisphere;
mod spherical_rectangle;
mod turn;
pub mod uniform_cone;
pub mod uniform_disk;
pub mod uniform_hemisphere;
pub mod uniform_sphere;
pub mod uniform_triangle;

pub use spherical_rectangle::SphericalRectangle;
pub(crate) use spherical_rectangle::{MIN_SOLID_ANGLE, Seen};
