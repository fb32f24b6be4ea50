//! [`Lobe`]: what a [`Bsdf`](super::Bsdf) holds.

use glam::{Vec2, Vec3};

use super::{BxDF, BxdfFlags, BxdfSample, LambertianReflection, OrenNayar};
use crate::spectrum::Spectrum;

/// A lobe in place: one of this crate's, or a reference to anyone's.
///
/// The crate's own are told apart by a branch that inlines; others cost a virtual call.
/// `benches/shading.rs` has the figures that this choice was made on.
#[derive(Clone, Copy)]
pub enum Lobe<'a> {
    /// See [`LambertianReflection`].
    Lambertian(LambertianReflection),
    /// See [`OrenNayar`].
    OrenNayar(OrenNayar),
    /// A model from elsewhere: see [`Arena::lobe`](super::Arena::lobe).
    Custom(&'a dyn BxDF),
}

impl From<LambertianReflection> for Lobe<'_> {
    #[inline]
    fn from(bxdf: LambertianReflection) -> Self {
        Self::Lambertian(bxdf)
    }
}

impl From<OrenNayar> for Lobe<'_> {
    #[inline]
    fn from(bxdf: OrenNayar) -> Self {
        Self::OrenNayar(bxdf)
    }
}

/// Passes a call on to whichever model the lobe is.
macro_rules! each {
    ($lobe:expr, $bxdf:ident => $call:expr) => {
        match $lobe {
            Lobe::Lambertian($bxdf) => $call,
            Lobe::OrenNayar($bxdf) => $call,
            Lobe::Custom($bxdf) => $call,
        }
    };
}

impl BxDF for Lobe<'_> {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        each!(self, bxdf => bxdf.flags())
    }

    #[inline]
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        each!(self, bxdf => bxdf.f(wo, wi))
    }

    #[inline]
    fn sample_f(&self, wo: Vec3, u: Vec2) -> Option<BxdfSample> {
        each!(self, bxdf => bxdf.sample_f(wo, u))
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        each!(self, bxdf => bxdf.pdf(wo, wi))
    }

    fn rho_hd(&self, wo: Vec3, u: &[Vec2]) -> Spectrum {
        each!(self, bxdf => bxdf.rho_hd(wo, u))
    }

    fn rho_hh(&self, u1: &[Vec2], u2: &[Vec2]) -> Spectrum {
        each!(self, bxdf => bxdf.rho_hh(u1, u2))
    }
}
