//! [`RetroReflection`]: glossy reflection back to where light came from.

use glam::{Vec2, Vec3};

use super::specular_reflection::mirrored;
use super::{BxDF, BxdfFlags, BxdfSample, MicrofacetReflection};
use crate::spectrum::Spectrum;

/// Glossy reflection around the direction from which light came, as of road signs and cats' eyes: [`MicrofacetReflection`] with the
/// direction of view mirrored about the normal (Portsmouth, Raab, Belcour and Liu 2026, Journal of Computer Graphics Techniques 15 (1)).
///
/// f(wo, wi) = f₀(wo', wi) with wo' = (-x, -y, z). It is reciprocal, since f₀ is and does not change when both directions are turned by
/// half a turn, and has the same albedo as f₀. Real reflectors work only near the normal, which an ordinary lobe beside this one
/// stands for.
#[derive(Clone, Copy, Debug)]
pub struct RetroReflection<'a> {
    base: MicrofacetReflection<'a>,
}

impl<'a> RetroReflection<'a> {
    /// Reflects as `base` does, but back.
    #[inline]
    pub const fn new(base: MicrofacetReflection<'a>) -> Self {
        Self { base }
    }
}

impl BxDF for RetroReflection<'_> {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        self.base.flags()
    }

    #[inline]
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        self.base.f(mirrored(wo), wi)
    }

    #[inline]
    fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample> {
        self.base.sample_f(mirrored(wo), uc, u)
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.base.pdf(mirrored(wo), wi)
    }

    #[inline]
    fn f_and_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        self.base.f_and_pdf(mirrored(wo), wi)
    }

    #[inline]
    fn uses_uc(&self) -> bool {
        self.base.uses_uc()
    }

    #[inline]
    fn albedo_estimate(&self, wo: Vec3) -> f32 {
        self.base.albedo_estimate(wo)
    }
}
