//! [`LambertianReflection`]: ideal diffuse reflection.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use super::{BxDF, BxdfFlags, WideBxdf};
use crate::geometry::Xyz;
use crate::simd::Block;
use crate::spectrum::{Bands, Spectrum};

/// Ideal diffuse reflection: the same radiance in all directions (PBRT 3rd edition, section 8.3).
///
/// f = R/π. Multiplied by cos θ and integrated over the hemisphere, f has to give the reflectance R, and
/// ∫ cos θ dω = π (PBRT 3rd edition, section 8.3).
#[doc(alias = "lambert")]
#[doc(alias = "diffuse")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LambertianReflection {
    r: [f32; 3],
}

impl LambertianReflection {
    /// Reflects nothing.
    pub(super) const BLACK: Self = Self::new(Spectrum::BLACK);

    /// Reflects the fraction `r` of incident light, in `[0, 1]` per band.
    #[inline]
    pub const fn new(r: Spectrum) -> Self {
        Self { r: r.to_array() }
    }
}

impl LambertianReflection {
    /// The numbers of the lobe.
    #[inline(always)]
    pub(super) fn numbers(&self) -> [f32; 3] {
        self.r
    }
}

/// [`LambertianReflection`] of any number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LambertianModel;

impl WideBxdf<3> for LambertianModel {
    #[inline(always)]
    fn f<F: Block>(self, r: [F; 3], _wo: Xyz<F>, _wi: Xyz<F>) -> Bands<F> {
        Bands(r) * F::splat(FRAC_1_PI)
    }
}

impl BxDF for LambertianReflection {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE
    }

    #[inline]
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        LambertianModel.f(self.numbers(), wo.into(), wi.into()).into()
    }

    #[inline]
    fn uses_uc(&self) -> bool {
        false
    }

    #[inline]
    fn albedo_estimate(&self, _wo: Vec3) -> f32 {
        Spectrum::from(self.r).max_component()
    }

    /// R for every direction.
    fn rho_hd(&self, _wo: Vec3, _uc: &[f32], _u: &[Vec2]) -> Spectrum {
        self.r.into()
    }

    /// R.
    fn rho_hh(&self, _u1: &[Vec2], _uc: &[f32], _u2: &[Vec2]) -> Spectrum {
        self.r.into()
    }
}
