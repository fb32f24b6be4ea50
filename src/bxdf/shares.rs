//! [`Shares`]: which of several lobes is sampled.

use arrayvec::ArrayVec;

use super::MAX_LOBES;
use crate::geometry::float::ONE_MINUS_EPSILON;
use crate::simd::Float;

/// Fraction of the selection probability that is uniform over the lobes; the rest is proportional to
/// [`BxDF::albedo_estimate`](super::BxDF::albedo_estimate). So a wrong estimate adds noise but never loses light.
const EQUAL_PART: f32 = 0.1;

/// The probabilities of two lobes.
#[inline(always)]
pub fn of_two<F: Float>([a, b]: [F; 2]) -> [F; 2] {
    let [a, b] = [clamped(a), clamped(b)];
    [share(a, a + b, 0.5), share(b, a + b, 0.5)]
}

#[inline(always)]
fn clamped<F: Float>(estimate: F) -> F {
    // False for NaN as well.
    let is_positive = estimate.gt(F::splat(0.0));
    F::select(is_positive, estimate.min(F::splat(1.0)), F::splat(0.0))
}

#[inline(always)]
fn share<F: Float>(estimate: F, sum: F, equal: f32) -> F {
    let share = F::select(sum.gt(F::splat(0.0)), estimate / sum, F::splat(equal));
    F::splat(EQUAL_PART * equal) + F::splat(1.0 - EQUAL_PART) * share
}

/// Selection probability of each lobe.
pub enum Shares {
    /// There is at most one lobe, which is always selected.
    All,
    /// Of two or more lobes: at least [`EQUAL_PART`] of a uniform probability.
    Each(ArrayVec<f32, MAX_LOBES>),
}

impl Shares {
    /// Probabilities of two or more lobes, proportional to their estimates except for [`EQUAL_PART`].
    #[inline(never)]
    pub fn new(mut estimates: ArrayVec<f32, MAX_LOBES>) -> Self {
        for estimate in &mut estimates {
            *estimate = clamped(*estimate);
        }
        let sum: f32 = estimates.iter().sum();
        let equal = 1.0 / estimates.len() as f32;
        for estimate in &mut estimates {
            *estimate = share(*estimate, sum, equal);
        }
        Self::Each(estimates)
    }

    #[inline]
    pub fn of(&self, lobe: usize) -> f32 {
        if let Self::Each(shares) = self { shares[lobe] } else { 1.0 }
    }

    /// The lobe that `uc` selects, and the remainder of `uc`, rescaled to `[0, 1)`.
    #[inline]
    pub fn choose(&self, uc: f32) -> (usize, f32) {
        let Self::Each(shares) = self else { return (0, uc) };
        let mut start = 0.0;
        for (lobe, share) in shares.iter().enumerate() {
            if uc < start + share || lobe + 1 == shares.len() {
                return (lobe, ((uc - start) / share).clamp(0.0, ONE_MINUS_EPSILON));
            }
            start += share;
        }
        (0, uc)
    }
}
