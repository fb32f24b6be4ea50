//! Fresnel's equations: how much a smooth surface reflects at an angle, for unpolarized light.

mod conductor;
mod dielectric;

pub use conductor::conductor;
pub(crate) use dielectric::boundary;
pub use dielectric::dielectric;

use crate::spectrum::Spectrum;

/// What a smooth surface reflects at each angle (PBRT 3rd edition, section 8.2.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fresnel {
    /// All light at all angles.
    NoOp,
    /// A boundary between media that do not absorb.
    Dielectric {
        /// Index of refraction below the surface, over that above it.
        eta: f32,
    },
    /// A metal. Light from below the surface, where none can come from, is reflected as from above.
    Conductor {
        /// Real part of the index of refraction in each band, over the index above the surface.
        eta: [f32; 3],
        /// Absorption: the imaginary part, over the index above the surface.
        k: [f32; 3],
    },
}

impl Fresnel {
    /// The fraction that is reflected of light whose direction has this cosine to the normal, negative below the surface.
    #[inline]
    pub fn evaluate(&self, cos: f32) -> Spectrum {
        match *self {
            Self::NoOp => Spectrum::WHITE,
            Self::Dielectric { eta } => {
                Spectrum::splat(dielectric(cos, if cos < 0.0 { 1.0 / eta } else { eta }))
            }
            Self::Conductor { eta, k } => conductor(cos, eta.into(), k.into()),
        }
    }

    /// The cosine-weighted mean of [`evaluate`](Self::evaluate) over directions above the surface: ∫ 2 F cos θ d(cos θ), by Gauss's rule with
    /// six points, to 1e-3.
    pub fn mean(&self) -> Spectrum {
        if let Self::Dielectric { eta } = *self
            && eta < 1.0
        {
            // Total reflection has an edge. n² times what crosses is the same from both sides.
            let inverse = Self::Dielectric { eta: 1.0 / eta };
            return Spectrum::WHITE - (Spectrum::WHITE - inverse.mean()) * (eta * eta);
        }
        // Abramowitz and Stegun, table 25.4.
        const POINTS: [[f32; 2]; 3] =
            [[0.238_619_2, 0.467_913_93], [0.661_209_4, 0.360_761_57], [0.932_469_5, 0.171_324_5]];
        let mut mean = Spectrum::BLACK;
        for [x, weight] in POINTS {
            for cos in [0.5 - 0.5 * x, 0.5 + 0.5 * x] {
                mean += self.evaluate(cos) * (cos * weight);
            }
        }
        mean
    }
}
