//! [`EnergyPreservingOrenNayar`]: rough diffuse reflection that loses no energy.

use std::f32::consts::{FRAC_1_PI, PI};

use glam::{Vec2, Vec3};

use super::{BxDF, BxdfFlags, BxdfSample, WideBxdf};
use crate::geometry::Xyz;
use crate::geometry::trig::same_side;
use crate::simd::{Block, Float};
use crate::spectrum::{Bands, Spectrum};

/// Rough diffuse reflection whose albedo is known in closed form, so that what light loses by being reflected once between the
/// grooves comes back by a second, smooth lobe. A white surface reflects all light at any roughness.
///
/// Portsmouth, Kutz and Hill 2025, "EON: A practical energy-preserving rough diffuse BRDF", Journal of Computer Graphics Techniques
/// 14 (1). With Fujii's s = wi · wo - cos θi cos θo, over max(cos θi, cos θo) where it is positive, and A = 1 / (1 + c₁ r),
/// f = ρ/π A (1 + r s) + ρₘ/π (1 - E(θi)) (1 - E(θo)) / (1 - Ē) (equations 9 and 14). E is the albedo of the first term for ρ = 1 and Ē
/// its mean: 1 - E = A r (c₁ - G(θ) / π) and 1 - Ē = A r (c₁ - c₂), so that A r cancels and nothing is 0/0 in a smooth surface.
///
/// It is reciprocal. It ignores that light which is reflected often looks back at its source as well.
#[doc(alias = "eon")]
#[doc(alias = "rough")]
#[doc(alias = "diffuse")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyPreservingOrenNayar {
    /// ρ A / π.
    once: [f32; 3],
    /// ρₘ A r / (π (c₁ - c₂)).
    often: [f32; 3],
    roughness: f32,
    /// Share of uniform directions among samples, but for a factor that depends on the direction: the tenth root of the roughness.
    spread: f32,
}

const C1: f32 = 0.5 - 2.0 / (3.0 * PI);
const C2: f32 = 2.0 / 3.0 - 28.0 / (15.0 * PI);

impl EnergyPreservingOrenNayar {
    /// Reflects the fraction `r` of light that is reflected once, in `[0, 1]` per band: a little more than the albedo of a rough surface.
    /// `roughness` is in `[0, 1]`; 0 gives Lambertian reflection.
    #[inline]
    pub fn new(r: Spectrum, roughness: f32) -> Self {
        let a = 1.0 / (1.0 + C1 * roughness);
        let mean = a * (1.0 + C2 * roughness);
        let of_band = |r: f32| r * r * mean / (1.0 - r * (1.0 - mean));
        let often = Spectrum::from(r.to_array().map(of_band));
        Self {
            once: (r * (a * FRAC_1_PI)).to_array(),
            often: (often * (a * roughness * FRAC_1_PI / (C1 - C2))).to_array(),
            roughness,
            spread: roughness.powf(0.1),
        }
    }

    /// π times the sum of both parts, each times a factor.
    fn sum(&self, once: f32, often: f32) -> Spectrum {
        (Spectrum::from(self.once) * once + Spectrum::from(self.often) * often) * PI
    }

    /// The reflected fraction of light from a direction: ρ E + ρₘ (1 - E).
    fn albedo(&self, wo: Vec3) -> Spectrum {
        let (g, left) = (g_over_pi::<f32>(wo.into()), left::<f32>(wo.into()));
        self.sum(1.0 + self.roughness * g, (C1 - C2) * left)
    }
}

/// G(θ) / π (equation 12), where G = s (θ - s c) + 2/3 (s/c (1 - s³) - s) with s = sin θ and c = cos θ. s/c (1 - s³) is
/// s c (1 + s + s²) / (1 + s), which is finite along the surface.
#[inline(always)]
fn g_over_pi<F: Float>(w: Xyz<F>) -> F {
    let one = F::splat(1.0);
    let (s, c) = ((w.x * w.x + w.y * w.y).sqrt(), w.z.abs());
    let beyond = s * c * (one + s + s * s) / (one + s) - s;
    let g = s * (s.atan2(c) - s * c) + F::splat(2.0 / 3.0) * beyond;
    // atan2 of (0, 0) is unspecified; s is 0 there, but not the product with NaN.
    F::select(s.gt(F::splat(0.0)), g * F::splat(FRAC_1_PI), F::splat(0.0))
}

/// What light loses by being reflected only once, in proportion: (1 - E) / (A r) = c₁ - G / π, 0 along the surface.
#[inline(always)]
fn left<F: Float>(w: Xyz<F>) -> F {
    (F::splat(C1) - g_over_pi(w)).max(F::splat(0.0))
}

/// How directions are sampled: uniformly with some probability, otherwise by a cosine that is transformed linearly in the
/// frame whose x axis is below wo, and clipped by the surface (section 5, listing 2).
struct Clipped<F> {
    /// The x axis: the direction of wo along the surface.
    x: [F; 2],
    uniform: F,
    a: F,
    b: F,
    c: F,
    d: F,
    /// The part of the unit disk that is above the surface.
    visible: F,
}

impl<F: Float> Clipped<F> {
    #[inline(always)]
    fn new(r: F, spread: F, wo: Xyz<F>) -> Self {
        let (zero, one, s) = (F::splat(0.0), F::splat(1.0), F::splat);
        let mu = wo.z.abs();
        let length = (wo.x * wo.x + wo.y * wo.y).sqrt();
        let is_askew = length.gt(zero);
        let x = [F::select(is_askew, wo.x / length, one), F::select(is_askew, wo.y / length, zero)];
        // Fits of the paper.
        let a = one
            + r * (s(0.303392)
                + (s(-0.518982) + s(0.111709) * mu) * mu
                + (s(-0.276266) + s(0.335918) * mu) * r);
        let b = r * (s(-1.16407) + s(1.15859) * mu + (s(0.150815) - s(0.150105) * mu) * r)
            / (mu * mu * mu - s(1.43545));
        let c = one + r * (s(0.20013) + (s(-0.506373) + s(0.261777) * mu) * mu);
        let d = r * (s(0.540852) + (s(-1.01625) + s(0.475392) * mu) * mu)
            / (s(-1.0743) + (s(0.0725628) + mu) * mu);
        let uniform =
            spread * (s(0.162925) + mu * (s(-0.372058) + (s(0.538233) - s(0.290822) * mu) * mu));
        let visible = s(0.5) * (one + one / (d * d + one).sqrt());
        Self { x, uniform, a, b, c, d, visible }
    }

    /// A direction in the hemisphere around +z.
    #[inline(always)]
    fn sample(&self, [u, v]: [F; 2]) -> Xyz<F> {
        let (zero, one) = (F::splat(0.0), F::splat(1.0));
        let is_uniform = u.lt(self.uniform);
        let rest = one - self.uniform;
        let u = F::select(is_uniform, u / self.uniform, (u - self.uniform) / rest);
        let u = u.max(zero).min(F::splat(1.0 - f32::EPSILON / 2.0));
        let [cos, sin] = v.unit_circle();

        let radius = u.sqrt();
        let y = radius * sin;
        let edge = ((one - y) * (one + y)).max(zero).sqrt();
        let x = -((one - self.visible) * edge + self.visible * (radius * cos));
        let z = (one - (x * x + y * y)).max(zero).sqrt();
        let w = Xyz { x: self.a * x + self.b * z, y: self.c * y, z: (self.d * x + z).max(zero) };
        let w = w / w.length_squared().sqrt();
        let [sx, sy] = self.x;
        let turned = Xyz { x: sx * w.x - sy * w.y, y: sy * w.x + sx * w.y, z: w.z };

        let across = ((one - u) * (one + u)).sqrt();
        let any = Xyz { x: across * cos, y: across * sin, z: u };
        Xyz::select(is_uniform, any, turned)
    }

    /// The density of a direction above the surface.
    #[inline(always)]
    fn pdf(&self, w: Xyz<F>) -> F {
        let zero = F::splat(0.0);
        let ([sx, sy], Self { a, b, c, d, .. }) = (self.x, self);
        let (x, y, z) = (sx * w.x + sy * w.y, sx * w.y - sy * w.x, w.z);
        let (a, b, c, d) = (*a, *b, *c, *d);
        // The inverse of the transform, times its determinant.
        let determinant = c * (a - b * d);
        let h = Xyz { x: c * (x - b * z), y: (a - b * d) * y, z: c * (a * z - d * x) };
        let h2 = h.length_squared();
        let clipped = h.z.max(zero) * determinant * determinant / (h2 * h2);
        let clipped = clipped * F::splat(FRAC_1_PI) / self.visible;
        let uniform = F::splat(0.5 * FRAC_1_PI);
        self.uniform * uniform + (F::splat(1.0) - self.uniform) * clipped
    }
}

impl EnergyPreservingOrenNayar {
    /// The numbers of the lobe.
    #[inline(always)]
    pub(super) fn numbers(&self) -> [f32; 8] {
        let Self { once: [r, g, b], often: [more_r, more_g, more_b], .. } = *self;
        [r, g, b, more_r, more_g, more_b, self.roughness, self.spread]
    }
}

/// [`EnergyPreservingOrenNayar`] of any number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EonModel;

impl WideBxdf<8> for EonModel {
    #[inline(always)]
    fn f<F: Block>(self, lobe: [F; 8], wo: Xyz<F>, wi: Xyz<F>) -> Bands<F> {
        let [r, g, b, more_r, more_g, more_b, roughness, _] = lobe;
        let (zero, one) = (F::splat(0.0), F::splat(1.0));
        // wi · wo - cos θi cos θo.
        let s = wo.x * wi.x + wo.y * wi.y;
        let larger_cos = wo.z.abs().max(wi.z.abs());
        let s = F::select(s.gt(zero), s / larger_cos, s);
        let once = Bands([r, g, b]) * (one + roughness * s);
        let often = Bands([more_r, more_g, more_b]) * (left(wo) * left(wi));
        let (Bands([r, g, b]), Bands([more_r, more_g, more_b])) = (once, often);
        Bands([r + more_r, g + more_g, b + more_b])
    }

    #[inline(always)]
    fn pdf<F: Block>(self, lobe: [F; 8], wo: Xyz<F>, wi: Xyz<F>) -> F {
        let [.., roughness, spread] = lobe;
        let above = Xyz { z: wi.z.abs(), ..wi };
        let pdf = Clipped::new(roughness, spread, wo).pdf(above);
        F::select(same_side(wo.z, wi.z), pdf, F::splat(0.0))
    }

    #[inline(always)]
    fn sample<F: Block>(self, lobe: [F; 8], wo: Xyz<F>, _uc: F, u: [F; 2]) -> Xyz<F> {
        let [.., roughness, spread] = lobe;
        let wi = Clipped::new(roughness, spread, wo).sample(u);
        Xyz { z: F::select(wo.z.lt(F::splat(0.0)), -wi.z, wi.z), ..wi }
    }
}

impl BxDF for EnergyPreservingOrenNayar {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE
    }

    #[inline]
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        EonModel.f(self.numbers(), wo.into(), wi.into()).into()
    }

    #[inline]
    fn sample_f(&self, wo: Vec3, _uc: f32, u: Vec2) -> Option<BxdfSample> {
        let wi = EonModel.sample(self.numbers(), wo.into(), f32::NAN, u.to_array()).into();
        let pdf = self.pdf(wo, wi);
        (pdf > 0.0).then(|| BxdfSample::diffuse(self.f(wo, wi), wi, pdf))
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        EonModel.pdf(self.numbers(), wo.into(), wi.into())
    }

    #[inline]
    fn uses_uc(&self) -> bool {
        false
    }

    /// The mean albedo: ρ Ē + ρₘ (1 - Ē).
    #[inline]
    fn albedo_estimate(&self, _wo: Vec3) -> f32 {
        self.rho_hh(&[], &[], &[]).max_component()
    }

    fn rho_hd(&self, wo: Vec3, _uc: &[f32], _u: &[Vec2]) -> Spectrum {
        self.albedo(wo)
    }

    fn rho_hh(&self, _u1: &[Vec2], _uc: &[f32], _u2: &[Vec2]) -> Spectrum {
        let (c2, left) = (C2 * self.roughness, (C1 - C2) * (C1 - C2));
        self.sum(1.0 + c2, left)
    }
}
