//! [`ScaledBxDF`]: a lobe multiplied by a spectrum.

use glam::{Vec2, Vec3};

use super::{BxDF, BxdfFlags, BxdfSample};
use crate::spectrum::Spectrum;

/// A lobe whose values are multiplied by a spectrum. Sampled directions and densities do not change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaledBxDF<B> {
    bxdf: B,
    scale: Spectrum,
}

impl<B: BxDF> ScaledBxDF<B> {
    /// `bxdf` times `scale`. Values of `scale` in `[0, 1]` per band conserve energy if `bxdf` does.
    #[inline]
    pub const fn new(bxdf: B, scale: Spectrum) -> Self {
        Self { bxdf, scale }
    }
}

impl<B: BxDF> BxDF for ScaledBxDF<B> {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        self.bxdf.flags()
    }

    #[inline]
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        self.scale * self.bxdf.f(wo, wi)
    }

    #[inline]
    fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample> {
        self.bxdf.sample_f(wo, uc, u).map(|s| BxdfSample { f: self.scale * s.f, ..s })
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.bxdf.pdf(wo, wi)
    }

    #[inline]
    fn f_and_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let (f, pdf) = self.bxdf.f_and_pdf(wo, wi);
        (self.scale * f, pdf)
    }

    #[inline]
    fn uses_uc(&self) -> bool {
        self.bxdf.uses_uc()
    }

    #[inline]
    fn albedo_estimate(&self, wo: Vec3) -> f32 {
        self.scale.max_component() * self.bxdf.albedo_estimate(wo)
    }

    fn rho_hd(&self, wo: Vec3, uc: &[f32], u: &[Vec2]) -> Spectrum {
        self.scale * self.bxdf.rho_hd(wo, uc, u)
    }

    fn rho_hh(&self, u1: &[Vec2], uc: &[f32], u2: &[Vec2]) -> Spectrum {
        self.scale * self.bxdf.rho_hh(u1, uc, u2)
    }
}
