//! [`LambertianTransmission`]: ideal diffuse transmission.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use super::{BxDF, BxdfFlags, BxdfSample};
use crate::sampling::cosine_hemisphere;
use crate::spectrum::Spectrum;

/// Ideal diffuse transmission: the same radiance in all directions of the other side, f = T/π, as through thin paper (PBRT 3rd edition,
/// section 8.3).
#[doc(alias = "translucent")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LambertianTransmission {
    t: [f32; 3],
}

impl LambertianTransmission {
    /// Transmits the fraction `t` of incident light, in `[0, 1]` per band.
    #[inline]
    pub const fn new(t: Spectrum) -> Self {
        Self { t: t.to_array() }
    }
}

impl BxDF for LambertianTransmission {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::TRANSMISSION | BxdfFlags::DIFFUSE
    }

    #[inline]
    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        Spectrum::from(self.t) * FRAC_1_PI
    }

    #[inline]
    fn sample_f(&self, wo: Vec3, _uc: f32, u: Vec2) -> Option<BxdfSample> {
        let mut wi = cosine_hemisphere::sample(u);
        wi.z = wi.z.copysign(-wo.z);
        let pdf = self.pdf(wo, wi);
        (pdf > 0.0).then(|| BxdfSample::diffuse(self.f(wo, wi), wi, pdf).transmitted(1.0))
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        let is_far = (wo.z > 0.0) != (wi.z > 0.0);
        if is_far { cosine_hemisphere::pdf(wi.z.abs()) } else { 0.0 }
    }

    #[inline]
    fn uses_uc(&self) -> bool {
        false
    }

    #[inline]
    fn albedo_estimate(&self, _wo: Vec3) -> f32 {
        Spectrum::from(self.t).max_component()
    }

    /// T for every direction.
    fn rho_hd(&self, _wo: Vec3, _uc: &[f32], _u: &[Vec2]) -> Spectrum {
        self.t.into()
    }

    /// T.
    fn rho_hh(&self, _u1: &[Vec2], _uc: &[f32], _u2: &[Vec2]) -> Spectrum {
        self.t.into()
    }
}
