//! [`PointLight`]: an isotropic point source.

use std::sync::Arc;

use glam::{BVec4A, Vec2, Vec3, Vec4};

use super::{BoundingSphere, Light, LightSample, LightSamplesX4, Read};
use crate::geometry::four::{Vec3x4, four};
use crate::params::{Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;

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
        let to_light = self.position - p;
        let distance2 = to_light.length_squared();
        let (li, wi) = (self.intensity / distance2, to_light / distance2.sqrt());
        (distance2 > 0.0).then_some(LightSample::from_point(li, wi, 1.0, self.position))
    }

    /// 4π I.
    fn power(&self, _scene: &BoundingSphere) -> Option<Spectrum> {
        Some(self.intensity * (4.0 * std::f32::consts::PI))
    }

    fn sample_li_x4(&self, points: &[Vec3x4], _: &[[Vec2; 4]], samples: &mut [LightSamplesX4]) {
        let from = Vec3x4::splat(self.position);
        for (&p, samples) in points.iter().zip(samples) {
            let to_light = from - p;
            let distance2 = to_light.length_squared();
            let falloff = distance2.to_array();
            *samples = LightSamplesX4 {
                exists: distance2.cmpgt(Vec4::ZERO),
                li: four(|i| self.intensity / falloff[i]),
                wi: to_light.divided_by(distance2.sqrt()),
                pdf: Vec4::ONE,
                from,
                is_near: BVec4A::TRUE,
            };
        }
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
