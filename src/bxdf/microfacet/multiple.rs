//! Directions for light that met several facets, about in proportion to what single scattering loses.

use std::f32::consts::FRAC_1_PI;

use crate::geometry::Xyz;
use crate::simd::{Block, Float};

/// Rougher surfaces are taken for ones of this roughness, for which the density is cosine-weighted but for 0.1 %.
const MOST: f32 = 0.999;

/// Draws directions above a surface of some roughness α: with s² = cos² θ + α² sin² θ, ln s² is uniform. Losses fall as α² / cos² θ down to
/// angles of α along the surface.
#[derive(Clone, Copy)]
pub struct Spread<F = f32> {
    /// α² and its logarithm.
    pub numbers: [F; 2],
}

impl Spread {
    #[inline]
    pub fn new(alpha: f32) -> Self {
        let alpha2 = alpha.min(MOST).powi(2);
        Self { numbers: [alpha2, alpha2.ln()] }
    }
}

impl<F: Float> Spread<F> {
    /// Density over solid angle at a cosine above 0.
    #[inline(always)]
    pub fn pdf(&self, cos: F) -> F {
        let ([alpha2, log], one) = (self.numbers, F::splat(1.0));
        let stretch2 = cos * cos + alpha2 * (one - cos) * (one + cos);
        F::splat(-FRAC_1_PI) * (one - alpha2) * cos / (stretch2 * log)
    }
}

impl<F: Block> Spread<F> {
    /// A direction with that density.
    #[inline(always)]
    pub fn sample(&self, [u, v]: [F; 2]) -> Xyz<F> {
        let ([alpha2, log], one) = (self.numbers, F::splat(1.0));
        let cos2 = alpha2 * (-v * log).each(f32::exp_m1) / (one - alpha2);
        let sin = (one - cos2).max(F::splat(0.0)).sqrt();
        let [cos_phi, sin_phi] = u.unit_circle();
        Xyz { x: sin * cos_phi, y: sin * sin_phi, z: cos2.sqrt() }
    }
}
