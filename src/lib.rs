//! PBRT's materials and reflection, with just enough renderer around them to use them in earnest.
#![warn(missing_docs)]
#![deny(unsafe_code)]

pub mod film;
pub mod shape;
mod spectrum;

pub use glam;
pub use spectrum::Spectrum;
