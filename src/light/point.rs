//! [`PointLight`]: an isotropic point source.

use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::block::{Incident, WideLight, sample_wide};
use super::{BoundingSphere, Light, LightBounds, LightSample, LightSamples, Read, Receivers};
use crate::geometry::Xyz;
use crate::params::{Fault, Key, Kind, Table};
use crate::simd::{Float, LaneMask};
use crate::spectrum::{Bands, Spectrum};

/// A point that emits the same intensity in all directions (PBRT 3rd edition, section 12.3).
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
}

impl Light for PointLight {
    fn is_delta(&self) -> bool {
        true
    }

    /// Irradiance falls with the squared distance, I / d². `None` at the light's own position.
    #[inline]
    fn sample_li(&self, p: Vec3, _u: Vec2) -> Option<LightSample> {
        self.incident(p.into(), [0.0; 2]).0.into_sample()
    }

    /// 4π I.
    fn power(&self, _scene: &BoundingSphere) -> Option<Spectrum> {
        Some(self.intensity * (4.0 * std::f32::consts::PI))
    }

    fn bounds(&self) -> Option<LightBounds> {
        Some(LightBounds::new(self.position, self.position))
    }

    fn sample_li_block(&self, receivers: &Receivers, samples: &mut LightSamples) {
        sample_wide(self, receivers, samples).for_each(drop);
    }
}

impl WideLight for PointLight {
    #[inline(always)]
    fn incident<F: Float>(&self, p: Xyz<F>, _u: [F; 2]) -> (Incident<F>, F::Mask) {
        let from = Xyz::splat(self.position);
        let to_light = from - p;
        let distance2 = to_light.length_squared();
        let incident = Incident {
            li: Bands::splat(self.intensity) / distance2,
            wi: to_light / distance2.sqrt(),
            pdf: F::select(distance2.gt(F::splat(0.0)), F::splat(1.0), F::splat(0.0)),
            from: Some(from),
        };
        (incident, F::Mask::splat(false))
    }
}

const POSITION: Key<Vec3> = Key::new("position", "where it is, in world space");
const INTENSITY: Key<Spectrum> =
    Key::new("intensity", "radiant intensity, in W / sr").at_least(0.0);

/// `type = "point"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "point",
    meaning: "A point that shines alike in all directions",
    keys: &[&POSITION, &INTENSITY],
    read,
};

fn read(table: &Table) -> Result<Arc<dyn Light>, Fault> {
    Ok(Arc::new(PointLight::new(table.get(&POSITION)?, table.get(&INTENSITY)?)))
}
