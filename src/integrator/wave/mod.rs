//! Buffers and shared stages of integrators: waves of samples, and the paths that start with them.

mod buffers;
mod compact;
mod counters;
pub mod dimension;
pub mod flat;
mod flat_lights;
mod paths;
mod rules;
mod shadow_rays;
mod vertices;

pub use buffers::Wave;
pub use counters::Counters;
pub use paths::{Path, Paths};
pub use rules::{PathRules, power_heuristic};
pub use shadow_rays::ShadowRays;
pub use vertices::Vertices;
