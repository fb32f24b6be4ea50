//! [`SpecularTransmission`]: refraction.

use glam::{Vec2, Vec3};

use super::fresnel::boundary;
use super::{BxDF, BxdfFlags, BxdfSample};
use crate::spectrum::Spectrum;

/// Perfect specular transmission: all light that is not reflected, in the refracted direction (PBRT 3rd edition, section 8.2.3).
///
/// It transmits the fraction t (1 - F(θ)) from both sides, where F is [`dielectric`](super::fresnel::dielectric); whatever is reflected
/// is lost, and there is nothing where all is. Radiance is scaled by 1/η², since the solid angle changes: paths
/// start at the camera.
#[doc(alias = "refraction")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpecularTransmission {
    t: [f32; 3],
    eta: f32,
}

impl SpecularTransmission {
    /// Scales what is not reflected by `t`, in `[0, 1]` per band. `eta` is the index of refraction below the surface, over that above it:
    /// above 0.
    #[inline]
    pub const fn new(t: Spectrum, eta: f32) -> Self {
        Self { t: t.to_array(), eta }
    }

    /// The transmitted fraction of light from a direction.
    #[inline]
    fn transmittance(&self, w: Vec3) -> Spectrum {
        Spectrum::from(self.t) * (1.0 - boundary(w.z, relative(self.eta, w))[0])
    }
}

impl BxDF for SpecularTransmission {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::TRANSMISSION | BxdfFlags::SPECULAR
    }

    /// Black: no given direction is exactly the refracted direction.
    #[inline]
    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        Spectrum::BLACK
    }

    #[inline]
    fn pdf(&self, _wo: Vec3, _wi: Vec3) -> f32 {
        0.0
    }

    #[inline]
    fn sample_f(&self, wo: Vec3, _uc: f32, _u: Vec2) -> Option<BxdfSample> {
        let eta = relative(self.eta, wo);
        let [reflected, cos] = boundary(wo.z, eta);
        (reflected < 1.0).then(|| transmitted(self.t.into(), wo, eta, cos, 1.0 - reflected, 1.0))
    }

    #[inline]
    fn uses_uc(&self) -> bool {
        false
    }

    #[inline]
    fn albedo_estimate(&self, wo: Vec3) -> f32 {
        self.transmittance(wo).max_component()
    }
}

/// The index of refraction on the far side of `w`, over that on its own.
#[inline]
pub(super) fn relative(eta: f32, w: Vec3) -> f32 {
    if w.z < 0.0 { 1.0 / eta } else { eta }
}

/// The event in which the fraction `t` `share` of light is refracted, drawn with that probability. `eta` is [`relative`] to wo, and
/// `cos` is the cosine of the refracted direction.
#[inline]
pub(super) fn transmitted(
    t: Spectrum,
    wo: Vec3,
    eta: f32,
    cos: f32,
    share: f32,
    probability: f32,
) -> BxdfSample {
    let wi = Vec3::new(-wo.x / eta, -wo.y / eta, -cos.copysign(wo.z));
    BxdfSample::specular(t * (share / (eta * eta * cos)), wi, probability).transmitted(eta)
}
