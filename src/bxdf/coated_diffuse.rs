//! [`CoatedDiffuse`]: diffuse reflection below a coat.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use super::microfacet::{Ggx, Losses, above};
use super::{BxDF, BxdfFlags};
use crate::spectrum::Spectrum;

/// Diffuse reflection by a base below a dielectric coat, smooth or rough: light enters the coat, is reflected by the base, and by the coat
/// from within, until it leaves. What the coat reflects is a lobe of its own, [`MicrofacetReflection`](super::MicrofacetReflection)
/// without multiple scattering: together, a white base is white at every angle and roughness, within the error of
/// the [`Losses`].
///
/// f = T(wo) T(wi) / (π T̄) · R T̄ᵢ / (1 - R (1 - T̄ᵢ)), where T is what the coat does not reflect, T̄ its mean over directions, and
/// T̄ᵢ = T̄ / η² its mean from within (Kelemen and Szirmay-Kalos 2001; for a smooth coat it is the equation of Mitsuba's `plastic` with
/// `nonlinear`). The base takes up what single scattering loses of the coat's reflection. Light is taken to be diffuse within the coat.
#[doc(alias = "plastic")]
#[derive(Clone, Copy, Debug)]
pub struct CoatedDiffuse<'a> {
    /// All but T(wo) T(wi).
    factor: [f32; 3],
    ggx: Ggx,
    losses: &'a Losses,
}

impl<'a> CoatedDiffuse<'a> {
    /// A base that reflects the fraction `r` of light, in `[0, 1]` per band. `alpha` is the roughness of the coat along x and along y; `losses`
    /// are those [of a coat](Losses::of_coat) with this roughness, which know its index: a debug assertion tells others.
    #[inline]
    pub fn new(r: Spectrum, alpha: [f32; 2], losses: &'a Losses) -> Self {
        let ggx = Ggx::new(alpha);
        debug_assert!(losses.are_of(false, &ggx), "losses of another surface");
        let (mean, eta) = (losses.mean(&ggx), losses.eta());
        let leaving = mean / (eta * eta);
        let of_band = |r: f32| r * leaving / (1.0 - r * (1.0 - leaving));
        let [red, green, blue] = r.to_array();
        let scale = if mean > 0.0 { FRAC_1_PI / mean } else { 0.0 };
        let factor = [of_band(red) * scale, of_band(green) * scale, of_band(blue) * scale];
        Self { factor, ggx, losses }
    }

    /// The fraction of light from a direction that enters the coat.
    #[inline]
    fn entering(&self, w: Vec3) -> f32 {
        self.losses.at(&self.ggx, w)
    }
}

impl BxDF for CoatedDiffuse<'_> {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE
    }

    #[inline]
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        let [wo, wi] = above(wo, wi);
        if wi.z <= 0.0 {
            return Spectrum::BLACK;
        }
        Spectrum::from(self.factor) * (self.entering(wo) * self.entering(wi))
    }

    #[inline]
    fn uses_uc(&self) -> bool {
        false
    }

    #[inline]
    fn albedo_estimate(&self, wo: Vec3) -> f32 {
        let [wo, _] = above(wo, wo);
        let mean = self.losses.mean(&self.ggx) * std::f32::consts::PI;
        self.entering(wo) * mean * Spectrum::from(self.factor).max_component()
    }
}
