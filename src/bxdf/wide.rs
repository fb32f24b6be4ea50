//! [`WideBxdf`]: the formulas of a model, for one pair of directions or for several at a time.

use crate::geometry::Xyz;
use crate::geometry::trig::same_side;
use crate::sampling::cosine_hemisphere;
use crate::simd::{Block, Float};
use crate::spectrum::Bands;

/// The formulas of a model that reflects and is no delta lobe, of which a lobe is `N` numbers. `self` is what all lobes of a material have in
/// common.
///
/// As for [`BxDF`](super::BxDF), directions are in shading coordinates, `wo.z` is not 0, and the defaults sample the
/// cosine.
pub trait WideBxdf<const N: usize>: Copy {
    /// Whether [`sample`](Self::sample) uses `uc`.
    #[inline(always)]
    fn uses_uc(self) -> bool {
        false
    }

    /// Value for a pair of directions.
    fn f<F: Block>(self, lobe: [F; N], wo: Xyz<F>, wi: Xyz<F>) -> Bands<F>;

    /// Density of `wi`.
    #[inline(always)]
    fn pdf<F: Block>(self, _lobe: [F; N], wo: Xyz<F>, wi: Xyz<F>) -> F {
        cosine_pdf(wo, wi)
    }

    /// Both.
    #[inline(always)]
    fn f_and_pdf<F: Block>(self, lobe: [F; N], wo: Xyz<F>, wi: Xyz<F>) -> (Bands<F>, F) {
        (self.f(lobe, wo, wi), self.pdf(lobe, wo, wi))
    }

    /// A direction drawn with that density.
    #[inline(always)]
    fn sample<F: Block>(self, _lobe: [F; N], wo: Xyz<F>, _uc: F, u: [F; 2]) -> Xyz<F> {
        cosine_sample(wo, u)
    }
}

/// The density of [`cosine_sample`].
#[inline(always)]
pub fn cosine_pdf<F: Float>(wo: Xyz<F>, wi: Xyz<F>) -> F {
    let pdf = cosine_hemisphere::pdf_wide(wi.z.abs());
    F::select(same_side(wo.z, wi.z), pdf, F::splat(0.0))
}

/// A direction on the side of `wo`, with a density proportional to its cosine.
#[inline(always)]
pub fn cosine_sample<F: Float>(wo: Xyz<F>, u: [F; 2]) -> Xyz<F> {
    let wi = cosine_hemisphere::sample_wide(u);
    Xyz { z: F::select(wo.z.lt(F::splat(0.0)), -wi.z, wi.z), ..wi }
}
