//! Buffers and shared stages of integrators: waves of samples, and the paths that start with them.

mod buffers;
mod by_material;
mod counters;
pub mod dimension;
mod escape;
mod paths;
mod pushed;
mod rules;
mod scatter;
mod shadow_rays;

pub use buffers::Wave;
pub use counters::Counters;
pub use escape::for_each_escaped;
pub use paths::{PathList, Paths, PathsAt};
pub use rules::PathRules;
pub use scatter::{Stage, Vertices};
pub use shadow_rays::ShadowRays;
