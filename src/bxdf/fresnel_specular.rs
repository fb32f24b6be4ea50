//! [`FresnelSpecular`]: a smooth boundary, such as that of glass.

use glam::{Vec2, Vec3};

use super::fresnel::boundary;
use super::specular_reflection::mirrored;
use super::specular_transmission::{relative, transmitted};
use super::{BxDF, BxdfFlags, BxdfSample};
use crate::spectrum::Spectrum;

/// Perfect specular reflection and transmission of a smooth boundary between media that do not absorb: one of both, drawn in proportion to
/// Fresnel's equations (PBRT 3rd edition, section 8.2.4).
///
/// From both sides the fraction r F(θ) is reflected and t (1 - F(θ)) refracted; with r = t = 1 no energy is lost. Radiance that
/// is refracted is scaled by 1/η², since the solid angle changes: paths start at the camera.
#[doc(alias = "glass")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FresnelSpecular {
    r: [f32; 3],
    t: [f32; 3],
    eta: f32,
}

impl FresnelSpecular {
    /// Scales what is reflected by `r` and what is refracted by `t`, in `[0, 1]` per band. `eta` is the index of refraction below the
    /// surface, over that above it: above 0.
    #[inline]
    pub const fn new(r: Spectrum, t: Spectrum, eta: f32) -> Self {
        Self { r: r.to_array(), t: t.to_array(), eta }
    }
}

impl BxDF for FresnelSpecular {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::TRANSMISSION | BxdfFlags::SPECULAR
    }

    /// Black: no given direction is exactly one of the two.
    #[inline]
    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        Spectrum::BLACK
    }

    #[inline]
    fn pdf(&self, _wo: Vec3, _wi: Vec3) -> f32 {
        0.0
    }

    #[inline]
    fn sample_f(&self, wo: Vec3, uc: f32, _u: Vec2) -> Option<BxdfSample> {
        let eta = relative(self.eta, wo);
        let [reflected, cos] = boundary(wo.z, eta);
        Some(if uc < reflected {
            let f = Spectrum::from(self.r) * (reflected / wo.z.abs());
            BxdfSample::specular(f, mirrored(wo), reflected)
        } else {
            let share = 1.0 - reflected;
            transmitted(self.t.into(), wo, eta, cos, share, share)
        })
    }

    #[inline]
    fn albedo_estimate(&self, wo: Vec3) -> f32 {
        let reflected = boundary(wo.z, relative(self.eta, wo))[0];
        let [r, t] = [self.r, self.t].map(Spectrum::from);
        (r * reflected + t * (1.0 - reflected)).max_component()
    }
}
