//! Lights: the contract [`Light`], one kind per file, and which of several a surface asks.

mod area;
mod distant;
mod light_sampler;
mod point;
mod rectangle;
mod sky;
mod strategy;
mod traits;

pub use area::AreaLight;
pub use distant::DistantLight;
pub use light_sampler::{LightChoice, LightSampler};
pub use point::PointLight;
pub use sky::SkyLight;
pub use strategy::LightStrategy;
pub(crate) use traits::one_by_one;
pub use traits::{BoundingSphere, Light, LightHit, LightSample, LightSamplesX4, Read};

use crate::params::Kind;

/// All kinds of lights that stand alone; surfaces that emit are shapes.
pub static LIGHTS: &[Kind<Read>] = &[point::KIND, distant::KIND, sky::KIND];
