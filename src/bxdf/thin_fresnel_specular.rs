//! [`ThinFresnelSpecular`]: a thin pane.

use glam::{Vec2, Vec3};

use super::fresnel::dielectric;
use super::specular_reflection::mirrored;
use super::{BxDF, BxdfFlags, BxdfSample};
use crate::spectrum::Spectrum;

/// A pane of a medium that does not absorb, too thin to displace light: its two parallel boundaries reflect light to and fro.
///
/// With F of one boundary, R = F + F (1 - F)² (1 + F² + ...) = 2F / (1 + F) is reflected; the rest goes straight through (Stokes 1862).
#[doc(alias = "thin dielectric")]
#[doc(alias = "window")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinFresnelSpecular {
    r: [f32; 3],
    t: [f32; 3],
    eta: f32,
}

impl ThinFresnelSpecular {
    /// Scales what is reflected by `r` and what is transmitted by `t`, in `[0, 1]` per band. `eta` is the index of refraction of the pane,
    /// over that around it: above 0.
    #[inline]
    pub const fn new(r: Spectrum, t: Spectrum, eta: f32) -> Self {
        Self { r: r.to_array(), t: t.to_array(), eta }
    }

    /// The reflected fraction.
    #[inline]
    fn reflected(&self, wo: Vec3) -> f32 {
        let f = dielectric(wo.z, self.eta);
        2.0 * f / (1.0 + f)
    }
}

impl BxDF for ThinFresnelSpecular {
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
        let reflected = self.reflected(wo);
        let value = |color: [f32; 3], share: f32| Spectrum::from(color) * (share / wo.z.abs());
        Some(if uc < reflected {
            BxdfSample::specular(value(self.r, reflected), mirrored(wo), reflected)
        } else {
            let share = 1.0 - reflected;
            BxdfSample::specular(value(self.t, share), -wo, share).transmitted(1.0)
        })
    }

    #[inline]
    fn albedo_estimate(&self, wo: Vec3) -> f32 {
        let reflected = self.reflected(wo);
        let [r, t] = [self.r, self.t].map(Spectrum::from);
        (r * reflected + t * (1.0 - reflected)).max_component()
    }
}
