//! [`PointLight`].

use glam::{Vec2, Vec3};

use super::{BoundingSphere, Light, LightSample};
use crate::Spectrum;

/// A light without extent that shines alike in all directions (PBRT 3rd edition, section 12.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    position: Vec3,
    intensity: Spectrum,
}

impl PointLight {
    /// A light at `position` in world space with radiant intensity `intensity`, in W / sr.
    pub fn new(position: Vec3, intensity: Spectrum) -> Self {
        Self { position, intensity }
    }

    #[inline]
    pub(crate) fn position(&self) -> Vec3 {
        self.position
    }

    #[inline]
    pub(crate) fn intensity(&self) -> Spectrum {
        self.intensity
    }
}

impl Light for PointLight {
    fn is_delta(&self) -> bool {
        true
    }

    /// The irradiance falls with the square of the distance, I / d². None at the light itself.
    #[inline]
    fn sample_li(&self, p: Vec3, _u: Vec2) -> Option<LightSample> {
        let to_light = self.position - p;
        let distance2 = to_light.length_squared();
        let sample = LightSample {
            li: self.intensity / distance2,
            wi: to_light / distance2.sqrt(),
            pdf: 1.0,
            from: Some(self.position),
        };
        (distance2 > 0.0).then_some(sample)
    }

    /// 4π I.
    fn power(&self, _scene: &BoundingSphere) -> Spectrum {
        self.intensity * (4.0 * std::f32::consts::PI)
    }
}
