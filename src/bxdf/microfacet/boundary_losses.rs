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

    /// The losses of light from above, or from below: of directions mirrored to z > 0.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A diffuse light crosses glass of index 1.5 by 0.9082 from above and 0.4036 from below. Seen to fail with the first taken for
    /// both, and with half of the mean.
    #[test]
    fn losses_are_divided_by_the_mean_transmittance() {
        let losses = BoundaryLosses::new(1.5, Roughnesses::Constant([0.5, 0.5]));
        let close = |[a, b]: [f32; 2], [c, d]: [f32; 2]| (a - c).abs().max((b - d).abs()) < 1e-3;
        let both = 0.5 * (0.9082 * 0.3 + 0.4036 * 2.25 * 0.2);
        assert!(close(losses.crossing([0.3, 0.2]), [both / 0.3, both / 0.45]));
        // At most all of what is lost crosses.
        assert!(close(losses.crossing([0.01, 0.2]), [1.0, 0.01 / 0.45]));
        assert_eq!(losses.crossing([0.0, 0.0]), [0.0; 2]);
    }
}
