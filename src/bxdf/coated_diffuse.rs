//! [`CoatedDiffuse`]: diffuse reflection below a coat.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;

use super::microfacet::{Ggx, Losses, above};
use super::{BxDF, BxdfFlags, WideBxdf};
use crate::geometry::Xyz;
use crate::simd::Block;
use crate::spectrum::{Bands, Spectrum};

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

    /// The numbers of the lobe.
    #[inline(always)]
    pub(super) fn numbers(&self) -> [f32; 5] {
        let ([r, g, b], [ax, ay]) = (self.factor, self.ggx.alpha());
        [r, g, b, ax, ay]
    }

    /// What it has in common with other lobes of its material.
    #[inline(always)]
    pub(super) fn model(&self) -> BaseModel<'a> {
        BaseModel { losses: self.losses }
    }
}

/// [`CoatedDiffuse`] of any number, by surfaces of one material.
#[derive(Clone, Copy)]
pub struct BaseModel<'a> {
    pub losses: &'a Losses,
}

impl BaseModel<'_> {
    /// Estimated albedo.
    #[inline(always)]
    pub fn albedo<F: Block>(self, [r, g, b, ax, ay]: [F; 5], wo: Xyz<F>) -> F {
        let (ggx, [wo, _]) = (Ggx::of([ax, ay]), above([wo, wo]));
        let mean = self.losses.mean(&ggx) * F::splat(std::f32::consts::PI);
        self.losses.at(&ggx, wo) * mean * Bands([r, g, b]).max_component()
    }
}

impl WideBxdf<5> for BaseModel<'_> {
    #[inline(always)]
    fn f<F: Block>(self, [r, g, b, ax, ay]: [F; 5], wo: Xyz<F>, wi: Xyz<F>) -> Bands<F> {
        let (ggx, [wo, wi]) = (Ggx::of([ax, ay]), above([wo, wi]));
        // What enters the coat from each direction.
        let entering = self.losses.at(&ggx, wo) * self.losses.at(&ggx, wi);
        (Bands([r, g, b]) * entering).only(wi.z.gt(F::splat(0.0)))
    }
}

impl BxDF for CoatedDiffuse<'_> {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE
    }

    #[inline]
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        self.model().f(self.numbers(), wo.into(), wi.into()).into()
    }

    #[inline]
    fn uses_uc(&self) -> bool {
        false
    }

    #[inline]
    fn albedo_estimate(&self, wo: Vec3) -> f32 {
        self.model().albedo(self.numbers(), wo.into())
    }
}
