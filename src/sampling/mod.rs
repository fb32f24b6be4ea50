//! Sampling: warps from the unit square to other domains, and the samplers that fill the square.

mod discrete;
mod hash;
mod independent;
mod sampler;
mod stratified;
mod warp;

pub use discrete::Discrete;
pub use independent::IndependentSampler;
pub use sampler::{SampleId, Sampler};
pub use stratified::StratifiedSampler;
pub(crate) use warp::{LEAST_SOLID_ANGLE, Seen};
pub use warp::{
    SphericalRectangle, concentric_disk, cosine_hemisphere, uniform_cone, uniform_disk,
    uniform_hemisphere, uniform_sphere, uniform_triangle,
};
