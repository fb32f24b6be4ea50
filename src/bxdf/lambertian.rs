//! [`LambertianReflection`]: ideal diffuse reflection.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use super::{BxDF, BxdfFlags};
use crate::spectrum::Spectrum;

/// Ideal diffuse reflection: the same radiance in all directions (PBRT 3rd edition, section 8.3).
///
/// f = R/π. Multiplied by cos θ and integrated over the hemisphere, f has to give the reflectance R, and
/// ∫ cos θ dω = π (PBRT 3rd edition, section 8.3).
#[doc(alias = "lambert")]
#[doc(alias = "diffuse")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LambertianReflection {
    r: Spectrum,
}

impl LambertianReflection {
    /// Reflects the fraction `r` of incident light, in `[0, 1]` per band.
    #[inline]
    pub const fn new(r: Spectrum) -> Self {
        Self { r }
    }
}

impl BxDF for LambertianReflection {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE
    }

    #[inline]
    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        self.r * FRAC_1_PI
    }

    #[inline]
    fn uses_uc(&self) -> bool {
        false
    }

    #[inline]
    fn albedo_estimate(&self, _wo: Vec3) -> f32 {
        self.r.max_component()
    }

    /// R for every direction.
    fn rho_hd(&self, _wo: Vec3, _uc: &[f32], _u: &[Vec2]) -> Spectrum {
        self.r
    }

    /// R.
    fn rho_hh(&self, _u1: &[Vec2], _uc: &[f32], _u2: &[Vec2]) -> Spectrum {
        self.r
    }
}
