//! Light sources: the trait [`Light`], one kind per file, and [`LightSampler`], which selects among several.
//!
//! ```
//! use lobe::Spectrum;
//! use lobe::glam::{Vec2, Vec3};
//! use lobe::light::{Light, PointLight};
//!
//! // A lamp of 8 W / sr, 2 units above the origin.
//! let lamp = PointLight::new(Vec3::new(0.0, 2.0, 0.0), Spectrum::splat(8.0));
//! let sample = lamp.sample_li(Vec3::ZERO, Vec2::new(0.5, 0.5)).unwrap();
//! assert_eq!(sample.wi, Vec3::Y);
//! // A surface that faces the lamp receives the irradiance I / d².
//! assert_eq!(sample.li, Spectrum::splat(8.0 / 4.0));
//! // No ray can hit a point.
//! assert!(lamp.is_delta());
//! ```

mod area;
mod block;
mod bounds;
mod distant;
mod emissive_mesh;
mod environment;
mod light_sampler;
mod point;
mod rectangle;
mod sample;
mod sky;
mod spot;
mod strategy;
mod textured_area;
mod traits;
mod tree;

pub use area::AreaLight;
pub use block::{Emitted, EscapedRays, LightSamples, Receivers};
pub use bounds::LightBounds;
pub use distant::DistantLight;
pub use environment::{EnvironmentError, EnvironmentLight, EnvironmentSettings};
pub use light_sampler::{LightChoice, LightSampler};
pub use point::PointLight;
pub use sample::{LightHit, LightSample};
pub use sky::SkyLight;
pub use spot::SpotLight;
pub use strategy::LightStrategy;
pub use textured_area::TexturedAreaLight;
pub use traits::{BoundingSphere, Light, Read};

use crate::params::Kind;

/// All kinds of lights of scene files. Surfaces that emit are shapes.
pub static LIGHTS: &[Kind<Read>] =
    &[point::KIND, spot::KIND, distant::KIND, sky::KIND, environment::KIND];
