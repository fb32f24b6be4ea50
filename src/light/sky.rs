//! [`SkyLight`]: constant environment light.

use std::f32::consts::PI;
use std::sync::Arc;

use glam::{BVec4A, Vec2, Vec3, Vec4};

use super::{BoundingSphere, Light, LightHit, LightSample, LightSamplesX4, Read};
use crate::geometry::four::Vec3x4;
use crate::params::{Fault, Key, Kind, Table};
use crate::sampling::uniform_sphere;
use crate::spectrum::Spectrum;

/// Constant environment light: the same radiance from every direction, like an overcast sky all around, or
/// like the furnace of a white furnace test.
#[doc(alias = "environment")]
#[doc(alias = "infinite")]
#[doc(alias = "furnace")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyLight {
    radiance: Spectrum,
}

impl SkyLight {
    /// A sky with this radiance, in W / (m² sr).
    pub fn new(radiance: Spectrum) -> Self {
        Self { radiance }
    }
}

impl Light for SkyLight {
    fn is_delta(&self) -> bool {
        false
    }

    fn is_infinite(&self) -> bool {
        true
    }

    fn is_worth_sampling(&self) -> bool {
        false
    }

    /// Uniform over the sphere.
    #[inline]
    fn sample_li(&self, _p: Vec3, u: Vec2) -> Option<LightSample> {
        let wi = uniform_sphere::sample(u).normalize();
        Some(LightSample::distant(self.radiance, wi, uniform_sphere::pdf()))
    }

    #[inline]
    fn pdf_li(&self, _hit: &LightHit) -> f32 {
        uniform_sphere::pdf()
    }

    #[inline]
    fn le(&self, _hit: &LightHit) -> Spectrum {
        self.radiance
    }

    /// 4π² r² L: radiance L from 4π sr, through the cross section of the scene's bounding sphere.
    fn power(&self, scene: &BoundingSphere) -> Option<Spectrum> {
        Some(self.radiance * (4.0 * PI * PI * scene.radius * scene.radius))
    }

    fn sample_li_x4(&self, _: &[Vec3x4], u: &[[Vec2; 4]], samples: &mut [LightSamplesX4]) {
        for (&u, samples) in u.iter().zip(samples) {
            let wi = uniform_sphere::sample_x4(u);
            *samples = LightSamplesX4 {
                exists: BVec4A::TRUE,
                li: [self.radiance; 4],
                wi: wi * (1.0 / wi.length_squared().sqrt()),
                pdf: Vec4::splat(uniform_sphere::pdf()),
                from: Vec3x4::ZERO,
                is_near: BVec4A::FALSE,
            };
        }
    }
}

const RADIANCE: Key<Spectrum> =
    Key::new("radiance", "from every direction, in W / (m² sr)").at_least(0.0);

/// `type = "sky"`
pub(super) const KIND: Kind<Read> =
    Kind { name: "sky", meaning: "The same radiance from everywhere", keys: &[&RADIANCE], read };

fn read(table: &Table) -> Result<Arc<dyn Light>, Fault> {
    Ok(Arc::new(SkyLight::new(table.get(&RADIANCE)?)))
}
