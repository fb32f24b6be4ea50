//! [`SpecularReflection`]: a mirror.

use glam::{Vec2, Vec3};

use super::fresnel::Fresnel;
use super::{BxDF, BxdfFlags, BxdfSample};
use crate::spectrum::Spectrum;

/// Perfect specular reflection: all light in the mirror direction (PBRT 3rd edition, section 8.2.2).
///
/// It reflects the fraction r F(θ) from both sides, where F are [Fresnel's equations](Fresnel). Whatever a dielectric refracts is lost.
#[doc(alias = "mirror")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpecularReflection {
    // Arrays, unlike spectra, need no alignment: all lobes of a Bsdf have the size of the largest.
    r: [f32; 3],
    fresnel: Fresnel,
}

impl SpecularReflection {
    /// Scales what `fresnel` reflects by `r`, in `[0, 1]` per band.
    #[inline]
    pub const fn new(r: Spectrum, fresnel: Fresnel) -> Self {
        Self { r: r.to_array(), fresnel }
    }

    /// The reflected fraction of light from a direction.
    #[inline]
    fn reflectance(&self, w: Vec3) -> Spectrum {
        Spectrum::from(self.r) * self.fresnel.evaluate(w.z)
    }
}

impl BxDF for SpecularReflection {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::SPECULAR
    }

    /// Black: no given direction is exactly the mirror direction.
    #[inline]
    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        Spectrum::BLACK
    }

    #[inline]
    fn pdf(&self, _wo: Vec3, _wi: Vec3) -> f32 {
        0.0
    }

    #[inline]
    fn sample_f(&self, wo: Vec3, _uc: f32, _u: Vec2) -> Option<BxdfSample> {
        let f = self.reflectance(wo) * (1.0 / wo.z.abs());
        Some(BxdfSample::specular(f, mirrored(wo), 1.0))
    }

    #[inline]
    fn uses_uc(&self) -> bool {
        false
    }

    #[inline]
    fn albedo_estimate(&self, wo: Vec3) -> f32 {
        self.reflectance(wo).max_component()
    }

    fn rho_hd(&self, wo: Vec3, _uc: &[f32], _u: &[Vec2]) -> Spectrum {
        self.reflectance(wo)
    }
}

/// The mirror direction.
#[inline]
pub(super) fn mirrored(wo: Vec3) -> Vec3 {
    Vec3::new(-wo.x, -wo.y, wo.z)
}
