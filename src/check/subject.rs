//! [`Subject`]: what is checked, a lobe or a sum of lobes.

use glam::{Vec2, Vec3};

use crate::bxdf::{Bsdf, BxDF, BxdfFlags, BxdfSample};
use crate::sampling::Random;
use crate::spectrum::Spectrum;

/// A scattering function in shading coordinates.
pub trait Subject {
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum;
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32;
    fn f_and_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32);
    fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample>;
    fn flags(&self) -> BxdfFlags;
    fn uses_uc(&self) -> bool;
    /// Whether flags of samples are the lobe's own.
    fn sets_flags(&self) -> bool;
}

/// A lobe. On sides that its flags exclude it is black, as in a [`Bsdf`].
pub struct Local<'a>(pub &'a dyn BxDF);

impl Local<'_> {
    /// Whether the flags include the event of these directions.
    fn scatters(&self, wo: Vec3, wi: Vec3) -> bool {
        let reflects = (wo.z > 0.0) == (wi.z > 0.0);
        let side = if reflects { BxdfFlags::REFLECTION } else { BxdfFlags::TRANSMISSION };
        self.0.flags().contains(side)
    }
}

impl Subject for Local<'_> {
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        if self.scatters(wo, wi) { self.0.f(wo, wi) } else { Spectrum::BLACK }
    }
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.0.pdf(wo, wi)
    }
    fn f_and_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let (f, pdf) = self.0.f_and_pdf(wo, wi);
        (if self.scatters(wo, wi) { f } else { Spectrum::BLACK }, pdf)
    }
    fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample> {
        self.0.sample_f(wo, uc, u)
    }
    fn flags(&self) -> BxdfFlags {
        self.0.flags()
    }
    fn uses_uc(&self) -> bool {
        self.0.uses_uc()
    }
    fn sets_flags(&self) -> bool {
        true
    }
}

impl Subject for Bsdf<'_> {
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        let [wo, wi] = [wo, wi].map(|w| self.frame().to_world(w));
        Bsdf::f(self, wo, wi, BxdfFlags::all())
    }
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        let [wo, wi] = [wo, wi].map(|w| self.frame().to_world(w));
        Bsdf::pdf(self, wo, wi, BxdfFlags::all())
    }
    fn f_and_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let [wo, wi] = [wo, wi].map(|w| self.frame().to_world(w));
        Bsdf::f_and_pdf(self, wo, wi, BxdfFlags::all())
    }
    fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample> {
        let wo = self.frame().to_world(wo);
        let mut sample = Bsdf::sample_f(self, wo, uc, u, BxdfFlags::all())?;
        sample.wi = self.frame().to_local(sample.wi);
        Some(sample)
    }
    fn flags(&self) -> BxdfFlags {
        self.all_flags()
    }
    fn uses_uc(&self) -> bool {
        Bsdf::uses_uc(self)
    }
    fn sets_flags(&self) -> bool {
        false
    }
}

/// Sample values for an event.
pub fn values(random: &mut Random) -> (f32, Vec2) {
    (random.next(), Vec2::new(random.next(), random.next()))
}

/// cos θ of the directions of view.
pub const COSINES: [f32; 8] = [1.0, 0.7, 0.3, 0.05, 1e-4, -1.0, -0.6, -0.05];

/// The unit vector with this cosine, askew to all axes.
pub fn view(cos: f32) -> Vec3 {
    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
    Vec3::new(0.8 * sin, 0.6 * sin, cos)
}
