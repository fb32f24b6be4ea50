//! [`SpotLight`]: a point that shines into a cone.

use std::f32::consts::TAU;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::block::{Incident, WideLight, sample_wide};
use super::{BoundingSphere, Light, LightBounds, LightSample, LightSamples, Read, Receivers};
use crate::geometry::float::MAX_COORDINATE;
use crate::geometry::{Xyz, unit};
use crate::params::{Fault, Key, Kind, Table};
use crate::simd::{Float, LaneMask};
use crate::spectrum::{Bands, Spectrum};

/// A point that shines into a cone, with a soft border (PBRT 3rd edition, section 12.3.2).
///
/// Its intensity is the same up to the angle where the falloff starts, and goes to zero at the cone's angle: in between it is
/// δ⁴ times as large, where δ falls linearly from 1 to 0 in the cosine of the angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpotLight {
    position: Vec3,
    axis: Vec3,
    intensity: Spectrum,
    /// 1 - cos of the cone's angle: cosines of narrow cones are 1 in f32.
    cone: f32,
    /// 1 - cos of the angle where the falloff starts.
    start: f32,
}

impl SpotLight {
    /// A light at `position` in world space that shines along `direction`, of any length, with radiant intensity `intensity`
    /// in the middle, in W / sr. `cone` and `falloff_start` are angles from the axis in degrees.
    ///
    /// `None` if the direction is zero or not finite, or unless 0 <= `falloff_start` <= `cone` <= 180 and `cone` > 0.
    pub fn new(
        position: Vec3,
        direction: Vec3,
        intensity: Spectrum,
        cone: f32,
        falloff_start: f32,
    ) -> Option<Self> {
        let is_cone = 0.0 <= falloff_start && falloff_start <= cone && cone <= 180.0 && cone > 0.0;
        let axis = unit(direction).filter(|_| is_cone)?;
        let [cone, start] = [cone, falloff_start].map(height);
        Some(Self { position, axis, intensity, cone, start })
    }
}

/// 1 - cos of an angle in degrees, as 2 sin² of its half.
fn height(degrees: f32) -> f32 {
    let sin = (f64::from(degrees).to_radians() / 2.0).sin();
    (2.0 * sin * sin) as f32
}

impl Light for SpotLight {
    fn is_delta(&self) -> bool {
        true
    }

    /// As of a point, times the falloff. `None` at the light's own position and outside of its cone.
    #[inline]
    fn sample_li(&self, p: Vec3, _u: Vec2) -> Option<LightSample> {
        self.incident(p.into(), [0.0; 2]).0.into_sample()
    }

    /// The intensity over all directions: 2π I ((1 - cos a) + (cos a - cos b) / 5) for a falloff from a to b. PBRT's estimate
    /// has 1/2 in place of 1/5.
    fn power(&self, _scene: &BoundingSphere) -> Option<Spectrum> {
        Some(self.intensity * (TAU * (self.start + (self.cone - self.start) / 5.0)))
    }

    fn bounds(&self) -> Option<LightBounds> {
        // From 1 - cos = 2 sin² of the half angle.
        let angle = |height: f32| 2.0 * (f64::from(height) / 2.0).sqrt().min(1.0).asin();
        let (cone, start) = (angle(self.cone), angle(self.start));
        let normals = start.max(cone - FRAC_PI_2);
        let bounds = LightBounds::new(self.position, self.position);
        Some(bounds.with_emission(self.axis, normals, cone - normals))
    }

    fn sample_li_block(&self, receivers: &Receivers, samples: &mut LightSamples) {
        sample_wide(self, receivers, samples).for_each(drop);
    }
}

impl WideLight for SpotLight {
    #[inline(always)]
    fn incident<F: Float>(&self, p: Xyz<F>, _u: [F; 2]) -> (Incident<F>, F::Mask) {
        let from = Xyz::splat(self.position);
        let to_light = from - p;
        let distance2 = to_light.length_squared();
        let wi = to_light / distance2.sqrt();
        // 1 - cos of the angle from the axis to -wi, without cancellation: half the square of the distance of both.
        let (zero, one) = (F::splat(0.0), F::splat(1.0));
        let height = F::splat(0.5) * (wi + Xyz::splat(self.axis)).length_squared();
        // Straight behind it is 2, or more by rounding: within a cone of 180 degrees.
        let height = height.min(F::splat(2.0_f32.next_down()));
        let (cone, start) = (F::splat(self.cone), F::splat(self.start));
        let delta = (cone - height) / (cone - start);
        let falloff = F::select(height.gt(start), delta * delta * (delta * delta), one);
        let is_lit = distance2.gt(zero) & height.lt(cone);
        let incident = Incident {
            li: Bands::splat(self.intensity) * falloff / distance2,
            wi,
            pdf: F::select(is_lit, one, zero),
            from: Some(from),
        };
        (incident, F::Mask::splat(false))
    }
}

/// [`MAX_COORDINATE`] as the decimal that it was rounded from.
const MAX: f64 = 1e12;
const _: () = assert!(MAX as f32 == MAX_COORDINATE);

const POSITION: Key<Vec3> = Key::new("position", "where it is, in world space").range(-MAX..=MAX);
const LOOK_AT: Key<Vec3> =
    Key::new("look_at", "a point in the middle of its cone").range(-MAX..=MAX).default(Vec3::ZERO);
const INTENSITY: Key<Spectrum> =
    Key::new("intensity", "radiant intensity in the middle, in W / sr").at_least(0.0);
const CONE_ANGLE: Key<f32> = Key::new("cone_angle", "from the middle of the cone to its border")
    .in_unit("degrees")
    .above(0.0)
    .at_most(180.0)
    .default(30.0);
const FALLOFF_START: Key<Option<f32>> = Key::optional(
    "falloff_start",
    "from the middle to where the light begins to fade; five sixths of cone_angle if left out",
)
.in_unit("degrees")
.range(0.0..=180.0);

/// `type = "spot"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "spot",
    meaning: "A point that shines into a cone with a soft border",
    keys: &[&POSITION, &LOOK_AT, &INTENSITY, &CONE_ANGLE, &FALLOFF_START],
    read,
};

fn read(table: &Table) -> Result<Arc<dyn Light>, Fault> {
    let (position, look_at) = (table.get(&POSITION)?, table.get(&LOOK_AT)?);
    let (intensity, cone) = (table.get(&INTENSITY)?, table.get(&CONE_ANGLE)?);
    let start = table.get(&FALLOFF_START)?;
    if let Some(start) = start.filter(|start| *start > cone) {
        let error = FadesOutside { start, cone };
        return Err(Fault::new(table.mark(&FALLOFF_START), error));
    }
    let start = start.unwrap_or(cone * (5.0 / 6.0));
    let light = SpotLight::new(position, look_at - position, intensity, cone, start);
    let light = light.ok_or_else(|| Fault::new(table.mark(&LOOK_AT), NoDirection));
    light.map(|light| Arc::new(light) as _)
}

#[derive(Debug, thiserror::Error)]
#[error("falloff_start is {start} degrees, expected at most cone_angle, which is {cone}")]
struct FadesOutside {
    start: f32,
    cone: f32,
}

#[derive(Debug, thiserror::Error)]
#[error("position and look_at are the same point")]
struct NoDirection;
