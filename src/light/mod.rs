//! Lights.

mod area;
mod distant;
mod known;
mod point;
mod rectangle;
mod sky;

pub use area::AreaLight;
pub use distant::DistantLight;
pub(crate) use known::{KnownLight, LightSamplesX4};
pub use point::PointLight;
pub use sky::SkyLight;

use std::sync::Arc;

use glam::{Vec2, Vec3};

use crate::params::{Fault, Kind, Table};
use crate::spectrum::Spectrum;

/// How a kind of light is read.
pub type Read = fn(&Table) -> Result<Arc<dyn Light>, Fault>;

/// All kinds of lights that stand alone; surfaces that emit are shapes.
pub static LIGHTS: &[Kind<Read>] = &[point::KIND, distant::KIND, sky::KIND];

/// Light that may arrive at a point, from one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Radiance in W / (m² sr); for a light without extent the irradiance that it gives a surface
    /// across the direction, in W / m².
    pub li: Spectrum,
    /// Unit direction from the point towards the light.
    pub wi: Vec3,
    /// Density over solid angle with which `wi` was drawn, above 0; 1 for a light without extent.
    pub pdf: f32,
    /// Where it comes from: it arrives if nothing stands between. A point of a surface is moved off that
    /// surface as far as its rounding errors ask for. `None` for light from infinitely far away.
    pub from: Option<Vec3>,
}

/// What a ray meets of a light that has an extent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightHit {
    /// The surface's point that the ray leaves, before its origin is moved off the surface.
    pub origin: Vec3,
    /// Its unit direction.
    pub wi: Vec3,
    /// How far away the light is, in scene units; infinite for a light that surrounds the scene.
    pub distance: f32,
    /// The unit geometric normal of the light's surface, pointing outside; zero for a light that surrounds
    /// the scene.
    pub n: Vec3,
}

/// A ball around the scene, which lights from infinity shine on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BoundingSphere {
    /// Its centre.
    pub center: Vec3,
    /// Its radius; 0 for a scene without triangles.
    pub radius: f32,
}

/// A source of light (PBRT 3rd edition, section 12.2).
///
/// A light without extent, a delta light, only has [`sample_li`](Light::sample_li) and its power. One that
/// surrounds the scene, or is a shape's surface, can also be met by rays, and tells what they see and how likely its
/// own samples are to go the same way, so that both can be weighed against each other.
pub trait Light: Send + Sync {
    /// Whether the light has no extent, so that it takes no sample and no ray can hit it.
    fn is_delta(&self) -> bool;

    /// Whether rays that leave the scene end at this light.
    fn is_infinite(&self) -> bool {
        false
    }

    /// Whether directions should be drawn from this light at all, where rays that follow the surface's own
    /// reflection can meet it too. A constant sky says no: a surface does not care which part of it it sees.
    fn is_worth_sampling(&self) -> bool {
        true
    }

    /// Light towards the point `p` in world space, for u in `[0, 1)²`. `None` when there is none.
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample>;

    /// Density over solid angle with which `sample_li` of the ray's origin gives its direction; 0 when it
    /// cannot. A delta light has none.
    fn pdf_li(&self, _hit: &LightHit) -> f32 {
        0.0
    }

    /// Radiance that the ray sees, in W / (m² sr). A delta light cannot be seen.
    fn le(&self, _hit: &LightHit) -> Spectrum {
        Spectrum::BLACK
    }

    /// Total power in W; of a light from infinity, what it sends through `scene`.
    fn power(&self, scene: &BoundingSphere) -> Spectrum;
}
