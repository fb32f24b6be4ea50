//! [`Coated`]: a rough coat and the base below it, as one lobe for several hits at a time.

use super::coated_diffuse::BaseModel;
use super::fresnel::boundary;
use super::microfacet::Losses;
use super::microfacet_reflection::FacetsModel;
use super::shares;
use super::wide::{cosine_pdf, cosine_sample};
use super::{CoatedDiffuse, MicrofacetReflection, WideBxdf};
use crate::geometry::Xyz;
use crate::simd::Block;
use crate::spectrum::Bands;

/// What a [`Bsdf`](super::Bsdf) of a [`MicrofacetReflection`] and a [`CoatedDiffuse`] is, in this order, or of the first alone.
pub struct Coated<'a> {
    coat: MicrofacetReflection<'a>,
    base: Option<CoatedDiffuse<'a>>,
    losses: &'a Losses,
}

impl<'a> Coated<'a> {
    /// `losses` are those of all bases of the material.
    #[inline(always)]
    pub fn new(
        coat: MicrofacetReflection<'a>,
        base: Option<CoatedDiffuse<'a>>,
        losses: &'a Losses,
    ) -> Self {
        Self { coat, base, losses }
    }

    /// The factors of the base, the roughness of both, and whether there is a base: 1 or 0. `None` if the coat is smooth, or rougher or
    /// smoother than what is below it.
    #[inline(always)]
    pub fn numbers(&self) -> Option<[f32; 6]> {
        let Self { coat, base, .. } = self;
        let ([ax, ay, ..], eta) = (coat.numbers(), coat.eta()?);
        let Some(base) = base else { return Some([0.0, 0.0, 0.0, ax, ay, 0.0]) };
        let [r, g, b, base_ax, base_ay] = base.numbers();
        let fits = [ax, ay] == [base_ax, base_ay] && eta == self.losses.eta();
        fits.then_some([r, g, b, ax, ay, 1.0])
    }

    #[inline(always)]
    pub fn model(&self) -> CoatModel<'a> {
        let (coat, losses) = (self.coat.model(), self.losses);
        CoatModel { coat, base: BaseModel { losses }, eta: losses.eta() }
    }
}

/// [`Coated`] of any number, by surfaces of one material.
#[derive(Clone, Copy)]
pub struct CoatModel<'a> {
    coat: FacetsModel<'a>,
    base: BaseModel<'a>,
    eta: f32,
}

impl PartialEq for CoatModel<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.coat == other.coat && std::ptr::eq(self.base.losses, other.base.losses)
    }
}

impl CoatModel<'_> {
    /// Probabilities of the coat and of the base.
    #[inline(always)]
    fn shares<F: Block>(self, [r, g, b, ax, ay, has_base]: [F; 6], wo: Xyz<F>) -> [F; 2] {
        let of_coat = boundary(wo.z.abs(), F::splat(self.eta))[0];
        let of_base = self.base.albedo([r, g, b, ax, ay], wo);
        let [coat, base] = shares::of_two([of_coat, of_base]);
        let has_base = has_base.gt(F::splat(0.0));
        [F::select(has_base, coat, F::splat(1.0)), F::select(has_base, base, F::splat(0.0))]
    }

    /// A lobe of the coat.
    #[inline(always)]
    fn of_coat<F: Block>([_, _, _, ax, ay, _]: [F; 6]) -> [F; 7] {
        let zero = F::splat(0.0);
        [ax, ay, zero, zero, zero, zero, zero]
    }
}

impl WideBxdf<6> for CoatModel<'_> {
    #[inline(always)]
    fn uses_uc(self) -> bool {
        true
    }

    #[inline(always)]
    fn f<F: Block>(self, lobe: [F; 6], wo: Xyz<F>, wi: Xyz<F>) -> Bands<F> {
        let [r, g, b, ax, ay, _] = lobe;
        self.coat.f(Self::of_coat(lobe), wo, wi) + self.base.f([r, g, b, ax, ay], wo, wi)
    }

    #[inline(always)]
    fn pdf<F: Block>(self, lobe: [F; 6], wo: Xyz<F>, wi: Xyz<F>) -> F {
        let [coat, base] = self.shares(lobe, wo);
        coat * self.coat.pdf(Self::of_coat(lobe), wo, wi) + base * cosine_pdf(wo, wi)
    }

    #[inline(always)]
    fn sample<F: Block>(self, lobe: [F; 6], wo: Xyz<F>, uc: F, u: [F; 2]) -> Xyz<F> {
        let [coat, _] = self.shares(lobe, wo);
        let by_coat = self.coat.sample(Self::of_coat(lobe), wo, uc, u);
        Xyz::select(uc.lt(coat), by_coat, cosine_sample(wo, u))
    }
}
