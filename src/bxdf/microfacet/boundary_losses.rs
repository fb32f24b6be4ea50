//! [`BoundaryLosses`]: what single scattering loses on both sides of a rough boundary.

use super::losses::mean_transmitted;
use super::returned::Interface;
use super::{Ggx, Losses, Roughnesses};

/// [`Losses`] of both sides of a boundary between media that do not absorb, and how what is lost is divided between them.
#[derive(Clone, Debug)]
pub struct BoundaryLosses {
    sides: [Losses; 2],
    eta: f32,
    /// The mean fraction of light that a smooth boundary transmits from above.
    transmitted: f32,
}

impl BoundaryLosses {
    /// `eta` is the index of refraction below the surface, over that above it: above 0.
    pub fn new(eta: f32, roughnesses: Roughnesses) -> Self {
        let of = |eta| Losses::new(Interface { eta: Some(eta), transmits: true }, roughnesses);
        Self { sides: [of(eta), of(1.0 / eta)], eta, transmitted: mean_transmitted(eta) }
    }

    /// Index of refraction below the surface, over that above it.
    #[inline]
    pub(in crate::bxdf) fn eta(&self) -> f32 {
        self.eta
    }

    /// What is lost of light from above the surface, or from below, for directions as if they were above.
    #[inline]
    pub(in crate::bxdf) fn side(&self, is_below: bool) -> &Losses {
        &self.sides[usize::from(is_below)]
    }

    /// The mean loss of light from above and from below, cosine-weighted.
    #[inline]
    pub(in crate::bxdf) fn means(&self, ggx: &Ggx) -> [f32; 2] {
        [self.sides[0].mean(ggx), self.sides[1].mean(ggx)]
    }

    /// The fractions of what is lost from above and from below that leave on the other side, from the [means](Self::means).
    ///
    /// Reciprocity asks for n² L̄ times it to be the same for both sides, where L̄ is the mean loss. It would be the mean transmittance
    /// of each if that were so; the mean of both products is taken, and at most what keeps either fraction below 1.
    #[inline]
    pub(in crate::bxdf) fn crossing(&self, [above, below]: [f32; 2]) -> [f32; 2] {
        let eta2 = self.eta * self.eta;
        let below = eta2 * below;
        // Of a smooth boundary, n² times the transmitted fraction is the same for both sides.
        let [from_above, from_below] = [self.transmitted, self.transmitted / eta2];
        let both = 0.5 * (from_above * above + from_below * below);
        let both = both.min(above).min(below);
        [above, below].map(|own| if own > 0.0 { both / own } else { 0.0 })
    }
}
