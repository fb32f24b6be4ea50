//! [`OrenNayar`]: rough diffuse reflection.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use super::{BxDF, BxdfFlags, WideBxdf};
use crate::geometry::Xyz;
use crate::geometry::trig::{abs_cos_theta, sin_theta, sin2_theta};
use crate::simd::Block;
use crate::spectrum::{Bands, Spectrum};

/// Rough diffuse reflection: V-shaped grooves with Lambertian sides, whose slopes have the standard
/// deviation sigma. It is brighter than Lambertian reflection towards the light, and looks flatter on
/// rounded bodies.
///
/// The qualitative model of Oren and Nayar 1994, "Generalization of Lambert's Reflectance Model",
/// equation 30, in PBRT's form (3rd edition, section 8.4.1):
/// f = R/π (A + B max(0, cos(φi - φo)) sin α tan β), where α is the larger and β the smaller of the two
/// angles to the normal.
///
/// It ignores interreflection between the grooves, so it loses energy: up to 44 % at sigma 90 degrees. Close
/// to the horizon it gains energy instead: at sigma 11 degrees it reflects up to 1.015 R there.
#[doc(alias = "rough")]
#[doc(alias = "diffuse")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrenNayar {
    r: [f32; 3],
    a: f32,
    b: f32,
}

impl OrenNayar {
    /// Reflects about the fraction `r` of incident light, in `[0, 1]` per band; `sigma` is the standard
    /// deviation of the slopes in degrees, in `[0, 90]`. Sigma 0 gives Lambertian reflection.
    #[inline]
    pub fn new(r: Spectrum, sigma: f32) -> Self {
        let sigma2 = sigma.to_radians().powi(2);
        let [a, b] = [1.0 - sigma2 / (2.0 * (sigma2 + 0.33)), 0.45 * sigma2 / (sigma2 + 0.09)];
        Self { r: r.to_array(), a, b }
    }
}

impl OrenNayar {
    /// The numbers of the lobe.
    #[inline(always)]
    pub(super) fn numbers(&self) -> [f32; 5] {
        let [r, g, b] = self.r;
        [r, g, b, self.a, self.b]
    }
}

/// [`OrenNayar`] of any number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrenNayarModel;

impl WideBxdf<5> for OrenNayarModel {
    #[inline(always)]
    fn f<F: Block>(self, [red, green, blue, a, b]: [F; 5], wo: Xyz<F>, wi: Xyz<F>) -> Bands<F> {
        // sin θi sin θo max(0, cos Δφ) is the dot product of the directions projected onto the surface, and
        // sin α tan β = sin θi sin θo / max(cos θi, cos θo): no angle has to be computed.
        let across = (wo.x * wi.x + wo.y * wi.y).max(F::splat(0.0));
        let larger_cos = wo.z.abs().max(wi.z.abs());
        Bands([red, green, blue]) * (F::splat(FRAC_1_PI) * (a + b * (across / larger_cos)))
    }
}

impl BxDF for OrenNayar {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE
    }

    #[inline]
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        OrenNayarModel.f(self.numbers(), wo.into(), wi.into()).into()
    }

    #[inline]
    fn uses_uc(&self) -> bool {
        false
    }

    /// R: roughness lowers the albedo by less than half.
    #[inline]
    fn albedo_estimate(&self, _wo: Vec3) -> f32 {
        Spectrum::from(self.r).max_component()
    }

    /// The integral of f cos θi in closed form: over φ, max(0, cos φ) gives 2; over θi it splits into the
    /// directions above and below wo. With c = cos θ and s = sin θ of wo,
    /// ρ = R (A + 2B/π [ s (θ - s c)/2 + (tan θ)(1 - s³)/3 ]).
    fn rho_hd(&self, wo: Vec3, _uc: &[f32], _u: &[Vec2]) -> Spectrum {
        let (cos, sin) = (abs_cos_theta(wo), sin_theta(wo));
        let theta = sin.atan2(cos);
        // tan θ (1 - s³) = s c (1 + s + s²) / (1 + s), which stays finite at grazing angles.
        let beyond = sin * cos * (1.0 + sin + sin2_theta(wo)) / (3.0 * (1.0 + sin));
        let within = 0.5 * sin * (theta - sin * cos);
        Spectrum::from(self.r) * (self.a + 2.0 * FRAC_1_PI * self.b * (within + beyond))
    }

    /// The cosine-weighted mean of ρ_hd: R (A + B (2/3 - 64/(45π))).
    fn rho_hh(&self, _u1: &[Vec2], _uc: &[f32], _u2: &[Vec2]) -> Spectrum {
        Spectrum::from(self.r) * (self.a + self.b * (2.0 / 3.0 - 64.0 / 45.0 * FRAC_1_PI))
    }
}
