//! [`SkyLight`]: constant environment light.

use std::f32::consts::PI;
use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::block::{Incident, WideLight, sample_wide};
use super::{
    BoundingSphere, Emitted, EscapedRays, Light, LightHit, LightSample, LightSamples, Read,
    Receivers,
};
use crate::geometry::Xyz;
use crate::params::{Fault, Key, Kind, Table};
use crate::sampling::uniform_sphere;
use crate::simd::{Float, LaneMask};
use crate::spectrum::{Bands, Spectrum};

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
        self.incident(Xyz::splat(Vec3::ZERO), u.to_array()).0.into_sample()
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

    fn sample_li_block(&self, receivers: &Receivers, samples: &mut LightSamples) {
        sample_wide(self, receivers, samples).for_each(drop);
    }

    fn escaped_block(&self, _rays: &EscapedRays, emitted: &mut Emitted) {
        emitted.fill(self.radiance, uniform_sphere::pdf());
    }
}

impl WideLight for SkyLight {
    #[inline(always)]
    fn incident<F: Float>(&self, _p: Xyz<F>, u: [F; 2]) -> (Incident<F>, F::Mask) {
        let incident = Incident {
            li: Bands::splat(self.radiance),
            wi: uniform_sphere::sample_wide(u).normalized(),
            pdf: F::splat(uniform_sphere::pdf()),
            from: None,
        };
        (incident, F::Mask::splat(false))
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
