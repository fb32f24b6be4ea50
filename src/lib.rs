//! The material and reflection system of PBRT (3rd edition), with just enough renderer around it to use
//! it in earnest.
//!
//! The rooms, from the ground up; none knows those below it in this list:
//!
//! - [`Spectrum`], linear RGB; [`params`], typed values with their places; [`geometry`], rays, shading frames and
//!   error-bounded points; [`sampling`], warps of the unit square and the samplers that fill it; [`image`], pictures,
//!   and PNG, EXR and PFM files;
//! - [`shape`], triangle meshes and OBJ files; [`interaction`], what is known about a hit;
//! - [`texture`], values over a surface; [`bxdf`], reflection models and their sum at a hit, [`bxdf::Bsdf`];
//!   [`material`], which turns textures into lobes; [`check`](mod@check), whether lobes and materials keep their contracts; [`light`];
//! - [`accel`], rays against all triangles; [`camera`]; [`film`], filters and sums of samples;
//! - [`scene`], what is rendered and how it is seen; [`integrator`], how light is computed;
//!   [`render`](mod@render), the loop;
//! - [`scene_file`], scenes from TOML;
//! - [`metrics`], errors between images, convergence and charts.
//!
//! # Features
//!
//! With `default-features = false` the crate is lobes, materials, lights, rays and rendering, with OBJ files in and PNG
//! files out. These add to it:
//!
//! - `scene-file`: [`scene_file`], which brings in the package `toml`;
//! - `exr`: [`image::write_exr`], and reading of such files by [`image::Image::read`]; brings in the package `exr`;
//! - `metrics`: [`metrics`], which needs no package;
//! - `cli`, the default: all of them, and what only the command `lobe` needs.
//!
//! # Traits
//!
//! Traits are the doors for other crates: [`bxdf::BxDF`], [`texture::Texture`], [`material::Material`],
//! [`light::Light`], [`camera::Camera`], [`film::Filter`], [`sampling::Sampler`] and [`integrator::Integrator`]. What
//! most callers need stands at the root. Lengths are in scene units, angles in the unit that each item names, and radiance is in
//! W / (m² sr) if a scene unit is a metre.
#![warn(missing_docs)]
#![deny(unsafe_code)]

pub mod accel;
pub mod bxdf;
pub mod camera;
pub mod check;
mod clock;
mod file;
pub mod film;
pub mod geometry;
pub mod image;
pub mod integrator;
pub mod interaction;
pub mod light;
pub mod material;
#[cfg(feature = "metrics")]
pub mod metrics;
pub mod params;
pub mod render;
pub mod sampling;
pub mod scene;
#[cfg(feature = "scene-file")]
pub mod scene_file;
pub mod shape;
mod simd;
mod spectrum;
pub mod texture;

pub use camera::PerspectiveSettings;
pub use glam;
pub use light::PointLight;
pub use material::MatteMaterial;
pub use render::{RenderOptions, RenderSettings, render};
pub use scene::{FilmSettings, Scene, View};
pub use shape::TriangleMesh;
pub use spectrum::Spectrum;

/// The README's program, compiled with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
