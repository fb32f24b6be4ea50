//! Directions for light that met several facets, about in proportion to what single scattering loses.

use std::f32::consts::{FRAC_1_PI, TAU};

use glam::{Vec2, Vec3};

/// Rougher surfaces are taken for ones of this roughness, for which the density is cosine-weighted but for 0.1 %.
const MOST: f32 = 0.999;

/// A direction above a surface of roughness `alpha`.
///
/// With s² = cos² θ + α² sin² θ, ln s² is uniform. Losses fall as α² / cos² θ down to angles of α along the surface.
#[inline]
pub fn sample(alpha: f32, u: Vec2) -> Vec3 {
    let alpha2 = alpha.min(MOST).powi(2);
    let cos2 = alpha2 * (-u.y * alpha2.ln()).exp_m1() / (1.0 - alpha2);
    let sin = (1.0 - cos2).max(0.0).sqrt();
    let (sin_phi, cos_phi) = (TAU * u.x).sin_cos();
    Vec3::new(sin * cos_phi, sin * sin_phi, cos2.sqrt())
}

/// Density over solid angle at a cosine above 0.
#[inline]
pub fn pdf(alpha: f32, cos: f32) -> f32 {
    let alpha2 = alpha.min(MOST).powi(2);
    let stretch2 = cos * cos + alpha2 * (1.0 - cos) * (1.0 + cos);
    -FRAC_1_PI * (1.0 - alpha2) * cos / (stretch2 * alpha2.ln())
}
