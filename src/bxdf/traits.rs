//! [`BxDF`], the trait of reflection models.

use glam::{DVec3, Vec2, Vec3};

use super::{cosine_pdf, cosine_sample};
use crate::geometry::trig::abs_cos_theta;
use crate::sampling::uniform_hemisphere;
use crate::spectrum::Spectrum;

bitflags::bitflags! {
    /// The kind of a lobe: to which side it scatters light, and how widely.
    ///
    /// As a filter, the flags are those that may occur: a lobe matches if all of its flags are among them.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct BxdfFlags: u8 {
        /// Light leaves on the side from which it came.
        const REFLECTION = 1;
        /// Light leaves on the other side.
        const TRANSMISSION = 2;
        /// Scattered over all directions.
        const DIFFUSE = 4;
        /// Scattered around one direction.
        const GLOSSY = 8;
        /// Scattered into a single direction: a delta distribution.
        #[doc(alias = "delta")]
        const SPECULAR = 16;
    }
}

/// A direction sampled from a lobe: one scattering event.
///
/// Its constructors name how the event scatters light, so that the flags are those of this event and not of
/// the whole lobe: [`diffuse`](Self::diffuse), [`glossy`](Self::glossy) or [`specular`](Self::specular).
/// Each is a reflection unless [`transmitted`](Self::transmitted) follows. [`Bsdf`](super::Bsdf) derives
/// the side again from `wo` and `wi`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct BxdfSample {
    /// Value for the pair of directions, without the cosine, in 1/sr. For a delta lobe: such that
    /// f |cos θi| / pdf is the fraction of light scattered this way.
    pub f: Spectrum,
    /// The direction that light comes from, a unit vector.
    pub wi: Vec3,
    /// Density over solid angle, above 0; for a specular event, its probability.
    pub pdf: f32,
    /// Kind of this event: one of `REFLECTION` and `TRANSMISSION`, and one of `DIFFUSE`, `GLOSSY` and
    /// `SPECULAR`.
    pub flags: BxdfFlags,
    /// Relative index of refraction across the event: the index on the side of `wi` divided by that on the
    /// side of `wo`; 1 for a reflection. Russian roulette uses it.
    pub eta: f32,
}

impl BxdfSample {
    /// A diffuse reflection; `pdf` is the density over solid angle.
    #[inline]
    pub const fn diffuse(f: Spectrum, wi: Vec3, pdf: f32) -> Self {
        Self::reflected(f, wi, pdf, BxdfFlags::DIFFUSE)
    }

    /// A glossy reflection; `pdf` is the density over solid angle.
    #[inline]
    pub const fn glossy(f: Spectrum, wi: Vec3, pdf: f32) -> Self {
        Self::reflected(f, wi, pdf, BxdfFlags::GLOSSY)
    }

    /// A specular reflection, which has only this direction and was selected with this probability.
    #[doc(alias = "delta")]
    #[doc(alias = "mirror")]
    #[inline]
    pub const fn specular(f: Spectrum, wi: Vec3, probability: f32) -> Self {
        Self::reflected(f, wi, probability, BxdfFlags::SPECULAR)
    }

    /// The same event as a transmission across an interface with the relative index of refraction
    /// [`eta`](Self::eta).
    #[inline]
    pub const fn transmitted(self, eta: f32) -> Self {
        let spread = self.flags.difference(BxdfFlags::REFLECTION);
        Self { flags: spread.union(BxdfFlags::TRANSMISSION), eta, ..self }
    }

    #[inline]
    const fn reflected(f: Spectrum, wi: Vec3, pdf: f32, spread: BxdfFlags) -> Self {
        Self { f, wi, pdf, flags: BxdfFlags::REFLECTION.union(spread), eta: 1.0 }
    }

    /// Whether the event has only this direction: a delta distribution.
    #[doc(alias = "delta")]
    #[inline]
    pub const fn is_specular(&self) -> bool {
        self.flags.contains(BxdfFlags::SPECULAR)
    }
}

/// One lobe: the ratio of radiance scattered along `wo` to irradiance arriving from `wi`, for reflection,
/// transmission, or both (PBRT 3rd edition, chapter 8).
///
/// All directions are unit vectors in shading coordinates and point away from the surface; `wo.z` is never 0
/// ([`Bsdf`](super::Bsdf) ensures it). A model implements `flags` and `f`. The default methods sample
/// cosine-weighted directions and estimate reflectances by Monte Carlo. Paths start at the camera and carry
/// radiance, so a refracting lobe includes the factor 1/η² in `f`.
///
/// ```
/// use lobe::Spectrum;
/// use lobe::bxdf::{BxDF, BxdfFlags};
/// use lobe::glam::{Vec2, Vec3};
///
/// /// Reflects half of the light, and only into the half space that it came from.
/// #[derive(Clone, Copy)]
/// struct HalfMoon;
///
/// impl BxDF for HalfMoon {
///     fn flags(&self) -> BxdfFlags {
///         BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE
///     }
///     fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
///         let side = if wo.truncate().dot(wi.truncate()) > 0.0 { 1.0 } else { 0.0 };
///         Spectrum::splat(side / std::f32::consts::PI)
///     }
/// }
///
/// let wo = Vec3::new(0.6, 0.0, 0.8);
/// let sample = HalfMoon.sample_f(wo, 0.5, Vec2::new(0.9, 0.6)).unwrap();
/// assert_eq!(sample.pdf, HalfMoon.pdf(wo, sample.wi));
/// assert_eq!(sample.f, HalfMoon.f(wo, sample.wi));
/// ```
///
/// A lobe with two events, one of which `uc` selects:
///
/// ```
/// use lobe::Spectrum;
/// use lobe::bxdf::{BxDF, BxdfFlags, BxdfSample};
/// use lobe::glam::{Vec2, Vec3};
///
/// /// A half-silvered window: reflects 30 % of the light like a mirror and transmits 70 %.
/// #[derive(Clone, Copy)]
/// struct HalfMirror;
///
/// impl BxDF for HalfMirror {
///     fn flags(&self) -> BxdfFlags {
///         BxdfFlags::REFLECTION | BxdfFlags::TRANSMISSION | BxdfFlags::SPECULAR
///     }
///     fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
///         Spectrum::BLACK // a delta lobe
///     }
///     fn pdf(&self, _wo: Vec3, _wi: Vec3) -> f32 {
///         0.0
///     }
///     fn sample_f(&self, wo: Vec3, uc: f32, _u: Vec2) -> Option<BxdfSample> {
///         let value = |share: f32| Spectrum::splat(share / wo.z.abs());
///         Some(if uc < 0.3 {
///             BxdfSample::specular(value(0.3), Vec3::new(-wo.x, -wo.y, wo.z), 0.3)
///         } else {
///             BxdfSample::specular(value(0.7), -wo, 0.7).transmitted(1.0)
///         })
///     }
/// }
/// ```
#[doc(alias = "brdf")]
#[doc(alias = "btdf")]
#[doc(alias = "bsdf")]
pub trait BxDF: Send + Sync {
    /// The kind of this lobe.
    fn flags(&self) -> BxdfFlags;

    /// Value for a pair of directions, without the cosine, in 1/sr: finite and not negative. It need not
    /// test on which side of the surface they lie: [`Bsdf`](super::Bsdf) has done so. But `wi.z` can be 0. A delta lobe
    /// returns black.
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum;

    /// Samples a direction `wi` for `wo` with the density [`pdf`](BxDF::pdf); `None` if these sample values
    /// give no direction. `uc` in `[0, 1)` selects one of the lobe's events, `u` in `[0, 1)²` the
    /// direction; both are uniform and independent.
    #[inline]
    fn sample_f(&self, wo: Vec3, _uc: f32, u: Vec2) -> Option<BxdfSample> {
        let wi = cosine_sample(wo.into(), u.to_array()).into();
        let pdf = self.pdf(wo, wi);
        (pdf > 0.0).then(|| {
            let f = self.f(wo, wi);
            match self.flags().contains(BxdfFlags::GLOSSY) {
                true => BxdfSample::glossy(f, wi, pdf),
                false => BxdfSample::diffuse(f, wi, pdf),
            }
        })
    }

    /// Density over solid angle with which `sample_f` returns `wi`; 0 for a delta lobe.
    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        cosine_pdf(wo.into(), wi.into())
    }

    /// [`f`](BxDF::f) and [`pdf`](BxDF::pdf) of one pair of directions, which is what most callers ask for. The default calls both:
    /// override it where they share work.
    #[inline]
    fn f_and_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        (self.f(wo, wi), self.pdf(wo, wi))
    }

    /// Whether `sample_f` uses `uc`. If not, one sample value per hit is saved, and `uc` is NaN.
    #[inline]
    fn uses_uc(&self) -> bool {
        true
    }

    /// Estimated fraction of uniform incident light that is scattered along `wo`, in `[0, 1]`. A
    /// [`Bsdf`](super::Bsdf) of several lobes selects lobes in proportion to it. It need not be exact: values
    /// and densities agree for any estimate, and estimates out of range are clamped. The default selects all
    /// lobes with equal probability.
    #[inline]
    fn albedo_estimate(&self, _wo: Vec3) -> f32 {
        1.0
    }

    /// Hemispherical-directional reflectance ρ_hd: the fraction of uniform incident light that is scattered
    /// along `wo`, in `[0, 1]` per band (PBRT 3rd edition, section 8.1.1). Of lobes that refract it is radiance, with their factor 1/η²: up to
    /// η² from within.
    ///
    /// The default is the Monte Carlo mean of f |cos θi| / pdf over the samples `uc` and `u` of
    /// [`sample_f`](BxDF::sample_f). The longer slice is truncated to the length of the shorter.
    fn rho_hd(&self, wo: Vec3, uc: &[f32], u: &[Vec2]) -> Spectrum {
        let estimate = |(&uc, &u): (&f32, &Vec2)| throughput(self.sample_f(wo, uc, u));
        mean(uc.iter().zip(u).filter_map(estimate), uc.len().min(u.len()))
    }

    /// Hemispherical-hemispherical reflectance ρ_hh: the fraction of uniform incident light that is
    /// scattered at all, in `[0, 1]` per band.
    ///
    /// The default is a Monte Carlo mean over triples of samples: `u1` for wo, uniform over the
    /// hemisphere, `uc` and `u2` for wi. The longer slices are truncated to the length of the shortest.
    fn rho_hh(&self, u1: &[Vec2], uc: &[f32], u2: &[Vec2]) -> Spectrum {
        let estimate = |((&u1, &uc), &u2): ((&Vec2, &f32), &Vec2)| {
            let wo = uniform_hemisphere::sample(u1);
            // 1/π ∫ ρ_hd cos θo dωo, divided by the density of wo.
            let weight = abs_cos_theta(wo) / (std::f32::consts::PI * uniform_hemisphere::pdf());
            let sample = (wo.z != 0.0).then(|| self.sample_f(wo, uc, u2)).flatten();
            throughput(sample).map(|t| t * weight)
        };
        let count = u1.len().min(uc.len()).min(u2.len());
        mean(u1.iter().zip(uc).zip(u2).filter_map(estimate), count)
    }
}

/// The sum divided by `count`, or black if that is 0. In f64: a long sum in f32 loses visible accuracy.
fn mean(estimates: impl Iterator<Item = Spectrum>, count: usize) -> Spectrum {
    let sum = estimates.fold(DVec3::ZERO, |sum, s| sum + Vec3::from(s.to_array()).as_dvec3());
    (sum / count.max(1) as f64).as_vec3().into()
}

/// f |cos θi| / pdf.
fn throughput(sample: Option<BxdfSample>) -> Option<Spectrum> {
    sample.map(|s| s.f * (abs_cos_theta(s.wi) / s.pdf))
}
