//! What the tests share.

pub mod rng;
pub mod sphere;
pub mod stats;

pub use rng::Rng;
