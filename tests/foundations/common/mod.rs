//! Shared helpers.

pub mod lobes;
pub mod meshes;
pub mod rng;
pub mod sphere;
pub mod stats;

pub use rng::Rng;
