//! Sampling: warps from the unit square to other domains, and the samplers that fill the square.

mod blue_noise;
mod discrete;
mod hash;
mod independent;
mod kind;
mod owen;
mod sampler;
mod sequence;
mod sobol;
mod stratified;
mod warp;

pub use blue_noise::BlueNoiseSampler;
pub use discrete::Discrete;
pub use independent::IndependentSampler;
pub use kind::{Make, SampleSets, SamplerKind};
pub use sampler::{SampleId, Sampler};
pub use sobol::SobolSampler;
pub use stratified::StratifiedSampler;
pub(crate) use warp::{LEAST_SOLID_ANGLE, Seen, SeenX4};
pub use warp::{
    SphericalRectangle, concentric_disk, cosine_hemisphere, uniform_cone, uniform_disk,
    uniform_hemisphere, uniform_sphere, uniform_triangle,
};

use crate::params::Kind;

/// All kinds of samplers.
pub static SAMPLERS: &[Kind<Make>] =
    &[independent::KIND, stratified::KIND, sobol::KIND, blue_noise::KIND];
