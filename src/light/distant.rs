//! [`DistantLight`]: parallel light.

use std::f32::consts::PI;
use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::{BoundingSphere, Light, LightSample, Read};
use crate::geometry::unit;
use crate::params::{Direction, Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;

/// Parallel light from an infinite distance, like the sun's (PBRT 3rd edition, section 12.4).
#[doc(alias = "directional")]
#[doc(alias = "sun")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistantLight {
    towards: Vec3,
    irradiance: Spectrum,
}

impl DistantLight {
    /// Light from the direction `towards` the light, in world space and of any length. `irradiance`, in W / m²,
    /// is what a surface perpendicular to the light receives. `None` if `towards` is zero or not finite.
    pub fn new(towards: Vec3, irradiance: Spectrum) -> Option<Self> {
        Some(Self { towards: unit(towards)?, irradiance })
    }
}

impl Light for DistantLight {
    fn is_delta(&self) -> bool {
        true
    }

    /// Independent of the point.
    #[inline]
    fn sample_li(&self, _p: Vec3, _u: Vec2) -> Option<LightSample> {
        Some(LightSample::distant(self.irradiance, self.towards, 1.0))
    }

    /// E π r²: the light that passes through the cross section of the scene's bounding sphere.
    fn power(&self, scene: &BoundingSphere) -> Option<Spectrum> {
        Some(self.irradiance * (PI * scene.radius * scene.radius))
    }
}

const DIRECTION: Key<Direction> =
    Key::new("direction", "where the light travels to, of any length");
const IRRADIANCE: Key<Spectrum> =
    Key::new("irradiance", "on a surface perpendicular to the light, in W / m²").at_least(0.0);

/// `type = "distant"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "distant",
    meaning: "Parallel light from infinitely far away, like the sun's",
    keys: &[&DIRECTION, &IRRADIANCE],
    read,
};

fn read(table: &Table) -> Result<Arc<dyn Light>, Fault> {
    let irradiance = table.get(&IRRADIANCE)?;
    let Direction(direction) = table.get(&DIRECTION)?;
    // The constructor takes the direction towards the light, a scene file the direction of travel.
    let light = DistantLight::new(-direction, irradiance);
    light.map(|light| Arc::new(light) as _).ok_or_else(|| table.missing(&DIRECTION))
}
