//! PBRT's materials and reflection, with just enough renderer around them to use them in earnest.
#![warn(missing_docs)]
#![deny(unsafe_code)]

pub mod accel;
pub mod bxdf;
mod camera;
pub mod film;
pub mod geometry;
pub mod integrator;
pub mod interaction;
pub mod light;
pub mod material;
pub mod render;
pub mod sampling;
pub mod scene;
pub mod shape;
mod spectrum;
pub mod texture;

pub use camera::{Camera, CameraError, CameraSettings};
pub use glam;
pub use light::PointLight;
pub use material::MatteMaterial;
pub use render::{RenderOptions, render};
pub use scene::Scene;
pub use shape::TriangleMesh;
pub use spectrum::Spectrum;
