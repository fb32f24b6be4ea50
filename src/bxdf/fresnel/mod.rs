//! Fresnel's equations: how much a smooth surface reflects at an angle, for unpolarized light.

mod conductor;
mod dielectric;

pub use conductor::conductor;
use conductor::of_conductor;
pub(crate) use dielectric::boundary;
pub use dielectric::dielectric;

use crate::simd::Float;
use crate::spectrum::{Bands, Spectrum};

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

    /// [`evaluate`](Self::evaluate) for directions above the surface.
    #[inline(always)]
    pub(crate) fn above<F: Float>(&self, cos: F) -> Bands<F> {
        match *self {
            Self::NoOp => Bands::splat(Spectrum::WHITE),
            Self::Dielectric { eta } => Bands([boundary(cos, F::splat(eta))[0]; 3]),
            Self::Conductor { eta, k } => of_conductor(cos, eta, k),
        }
    }

    /// The cosine-weighted mean of [`evaluate`](Self::evaluate) over directions above the surface: ∫ F d(cos² θ), in 4096 steps, to 1e-4.
    pub fn mean(&self) -> Spectrum {
        const STEPS: u32 = 4096;
        let mut sum = [0.0_f64; 3];
        for i in 0..STEPS {
            let cos = ((i as f32 + 0.5) / STEPS as f32).sqrt();
            for (sum, f) in sum.iter_mut().zip(self.evaluate(cos).to_array()) {
                *sum += f64::from(f);
            }
        }
        sum.map(|sum| (sum / f64::from(STEPS)) as f32).into()
    }
}
