//! Lobes of the tests, as another crate may define them.

use std::f32::consts::{FRAC_1_PI, PI};
use std::sync::atomic::{AtomicU32, Ordering};

use lobe::Spectrum;
use lobe::bxdf::{BxDF, BxdfFlags, BxdfSample};
use lobe::glam::{Vec2, Vec3};
use lobe::sampling::cosine_hemisphere;

/// A glossy, anisotropic lobe with sampling of its own: the cosine hemisphere stretched along x and
/// y by M (Heitz et al. 2016, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines").
/// f cos θ is R times the density, so its albedo is R for every direction.
#[derive(Clone, Copy)]
pub struct Stretched {
    pub r: f32,
    pub m: Vec3,
}

impl BxDF for Stretched {
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::GLOSSY
    }

    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        let cos = wi.z.abs();
        Spectrum::splat(if cos > 0.0 { self.r * self.pdf(wo, wi) / cos } else { 0.0 })
    }

    fn sample_f(&self, wo: Vec3, _uc: f32, u: Vec2) -> Option<BxdfSample> {
        let mut wi = (self.m * cosine_hemisphere::sample(u)).normalize();
        wi.z = wi.z.copysign(wo.z);
        let pdf = self.pdf(wo, wi);
        (pdf > 0.0).then(|| BxdfSample::glossy(self.f(wo, wi), wi, pdf))
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if wi.z == 0.0 || (wi.z > 0.0) != (wo.z > 0.0) {
            return 0.0;
        }
        let before = wi / self.m;
        let length = before.length();
        let cos = before.z.abs() / length;
        cos * FRAC_1_PI / (length.powi(3) * self.m.element_product())
    }
}

/// Lambert's law on the other side of the surface.
#[derive(Clone, Copy)]
pub struct Through(pub f32);

impl BxDF for Through {
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::TRANSMISSION | BxdfFlags::DIFFUSE
    }

    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        Spectrum::splat(self.0 * FRAC_1_PI)
    }

    fn sample_f(&self, wo: Vec3, _uc: f32, u: Vec2) -> Option<BxdfSample> {
        let mut wi = cosine_hemisphere::sample(u);
        wi.z = wi.z.copysign(-wo.z);
        let pdf = self.pdf(wo, wi);
        (pdf > 0.0).then(|| BxdfSample::diffuse(self.f(wo, wi), wi, pdf).transmitted(1.0))
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if (wi.z > 0.0) != (wo.z > 0.0) { wi.z.abs() * FRAC_1_PI } else { 0.0 }
    }
}

/// Lambert's law on both sides: `uc` chooses the side.
#[derive(Clone, Copy)]
pub struct BothSides {
    pub reflects: f32,
    pub transmits: f32,
}

impl BothSides {
    /// The albedo of the side, and how likely it is chosen.
    fn side(&self, wo: Vec3, wi: Vec3) -> (f32, f32) {
        let r = if (wi.z > 0.0) == (wo.z > 0.0) { self.reflects } else { self.transmits };
        (r, r / (self.reflects + self.transmits))
    }
}

impl BxDF for BothSides {
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::TRANSMISSION | BxdfFlags::DIFFUSE
    }

    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        Spectrum::splat(self.side(wo, wi).0 * FRAC_1_PI)
    }

    fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample> {
        let reflects = uc < self.side(wo, wo).1;
        let mut wi = cosine_hemisphere::sample(u);
        wi.z = wi.z.copysign(if reflects { wo.z } else { -wo.z });
        let pdf = self.pdf(wo, wi);
        let event = BxdfSample::diffuse(self.f(wo, wi), wi, pdf);
        (pdf > 0.0).then_some(if reflects { event } else { event.transmitted(1.0) })
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.side(wo, wi).1 * wi.z.abs() * FRAC_1_PI
    }
}

/// A delta lobe: a mirror, or with `eta` a smooth boundary that only transmits.
#[derive(Clone, Copy)]
pub struct Delta {
    pub r: f32,
    pub eta: Option<f32>,
}

impl BxDF for Delta {
    fn flags(&self) -> BxdfFlags {
        let side = if self.eta.is_some() { BxdfFlags::TRANSMISSION } else { BxdfFlags::REFLECTION };
        side | BxdfFlags::SPECULAR
    }

    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        Spectrum::BLACK
    }

    fn sample_f(&self, wo: Vec3, _uc: f32, _u: Vec2) -> Option<BxdfSample> {
        let n = Vec3::Z * wo.z.signum();
        let event = |wi: Vec3| BxdfSample::specular(Spectrum::splat(self.r / wi.z.abs()), wi, 1.0);
        let Some(eta) = self.eta else {
            return Some(event(lobe::geometry::reflect(wo, n)));
        };
        let eta = if wo.z > 0.0 { eta } else { 1.0 / eta };
        Some(event(lobe::geometry::refract(wo, n, 1.0 / eta)?).transmitted(eta))
    }

    fn pdf(&self, _wo: Vec3, _wi: Vec3) -> f32 {
        0.0
    }
}

/// Wraps a lobe's `f` only: everything else is the trait's default.
#[derive(Clone, Copy)]
pub struct Plain<B>(pub B);

impl<B: BxDF> BxDF for Plain<B> {
    fn flags(&self) -> BxdfFlags {
        self.0.flags()
    }
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        self.0.f(wo, wi)
    }
}

/// Returns constant results.
#[derive(Clone, Copy)]
pub struct Broken {
    pub f: f32,
    pub pdf: f32,
    pub wi: Vec3,
    pub flags: BxdfFlags,
}

impl Broken {
    /// Gives the answers of a diffuser but for the value.
    pub fn with_f(f: f32) -> Self {
        let flags = BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE;
        Self { f, pdf: 1.0 / PI, wi: Vec3::Z, flags }
    }
}

impl BxDF for Broken {
    fn flags(&self) -> BxdfFlags {
        self.flags
    }
    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        Spectrum::new(0.1, self.f, 0.1)
    }
    fn sample_f(&self, wo: Vec3, _uc: f32, _u: Vec2) -> Option<BxdfSample> {
        let event = match self.flags.contains(BxdfFlags::SPECULAR) {
            true => BxdfSample::specular,
            false => BxdfSample::diffuse,
        };
        Some(event(self.f(wo, self.wi), self.wi, self.pdf))
    }
    fn pdf(&self, _wo: Vec3, _wi: Vec3) -> f32 {
        self.pdf
    }
    fn rho_hd(&self, wo: Vec3, _uc: &[f32], _u: &[Vec2]) -> Spectrum {
        self.f(wo, wo)
    }
    fn rho_hh(&self, _u1: &[Vec2], _uc: &[f32], _u2: &[Vec2]) -> Spectrum {
        self.f(Vec3::Z, Vec3::Z)
    }
}

/// Counts its calls.
#[derive(Default)]
pub struct Counting(AtomicU32);

impl Counting {
    pub fn calls(&self) -> u32 {
        self.0.load(Ordering::Relaxed)
    }
}

impl BxDF for Counting {
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE
    }
    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        self.0.fetch_add(1, Ordering::Relaxed);
        Spectrum::WHITE
    }
    fn pdf(&self, _wo: Vec3, _wi: Vec3) -> f32 {
        self.0.fetch_add(1, Ordering::Relaxed);
        1.0
    }
}
