//! Lights.

mod point;

pub use point::PointLight;

use glam::{Vec2, Vec3};

use crate::Spectrum;

/// Light that may arrive at a point, from one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Radiance in W / (m² sr); for a light without extent the irradiance that it gives a surface
    /// across the direction, in W / m².
    pub li: Spectrum,
    /// Unit direction from the point towards the light.
    pub wi: Vec3,
    /// Density over solid angle with which `wi` was drawn; 1 for a light without extent.
    pub pdf: f32,
    /// Where on the light it comes from: it arrives if nothing stands between.
    pub from: Vec3,
}

/// A source of light (PBRT 3rd edition, section 12.2).
pub trait Light: Send + Sync {
    /// Whether the light has no extent, so that it takes no sample and no ray can hit it.
    fn is_delta(&self) -> bool;

    /// Light towards the point `p` in world space, for u in `[0, 1)²`. `None` when there is none.
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample>;
}
