//! Sampling: samplers, which supply points of the unit square; warps, which take these to other
//! domains; and discrete distributions.
//!
//! - A [`Sampler`] gives each use of random numbers along a path, called a dimension, a value in
//!   `[0, 1)` or a point in `[0, 1)²`: [`IndependentSampler`], [`StratifiedSampler`],
//!   [`SobolSampler`], [`BlueNoiseSampler`].
//! - A warp takes such a point to a disk, sphere, cone or shape. Each has `sample`, `pdf` and
//!   `inverse`.
//! - [`Discrete`] draws an index by weight, [`Discrete2d`] a cell of a grid.
//!
//! An estimate of an integral is the mean of f / pdf over samples. For example the irradiance of a
//! surface under a sky of radiance cos θ, ∫ cos² θ dω = 2π/3:
//!
//! ```
//! use lobe::glam::UVec2;
//! use lobe::sampling::{SampleId, Sampler, SobolSampler, cosine_hemisphere};
//!
//! let sampler = SobolSampler::new(0);
//! let n = 256;
//! let sum: f32 = (0..n)
//!     .map(|index| {
//!         let u = sampler.get_2d(SampleId { pixel: UVec2::ZERO, set: 0, index }, 0);
//!         let cos = cosine_hemisphere::sample(u).z;
//!         cos * cos / cosine_hemisphere::pdf(cos)
//!     })
//!     .sum();
//! assert!((sum / n as f32 - 2.0 / 3.0 * std::f32::consts::PI).abs() < 1e-2);
//! ```

mod blue_noise;
mod discrete;
mod discrete_2d;
mod hash;
mod independent;
mod kind;
mod owen;
mod permutation;
mod random;
mod sampler;
mod sequence;
mod sobol;
mod stratified;
mod warp;
mod wide;

pub use blue_noise::BlueNoiseSampler;
pub use discrete::Discrete;
pub use discrete_2d::{Cell, Discrete2d};
pub(crate) use hash::{mix, unit_float};
pub use independent::IndependentSampler;
pub use kind::{Make, SampleSets, SamplerKind};
pub(crate) use random::Random;
pub use sampler::{SampleId, Sampler};
pub use sobol::SobolSampler;
pub use stratified::StratifiedSampler;
pub(crate) use warp::{MIN_SOLID_ANGLE, Seen};
pub use warp::{
    SphericalRectangle, bilinear, concentric_disk, cosine_hemisphere, uniform_cone, uniform_disk,
    uniform_hemisphere, uniform_sphere, uniform_triangle,
};

use crate::params::Kind;

/// All kinds of samplers.
pub static SAMPLERS: &[Kind<Make>] =
    &[independent::KIND, stratified::KIND, sobol::KIND, blue_noise::KIND];

impl SamplerKind {
    /// All of [`SAMPLERS`].
    pub fn all() -> impl Iterator<Item = Self> {
        SAMPLERS.iter().map(Self)
    }
}
