//! The contract of reflection models.

use glam::{DVec3, Vec2, Vec3};

use crate::geometry::trig::{abs_cos_theta, same_hemisphere};
use crate::sampling::{cosine_hemisphere, uniform_hemisphere};
use crate::spectrum::Spectrum;

bitflags::bitflags! {
    /// What a lobe does with light: which side it sends it to, and how it spreads it.
    ///
    /// As a question, the flags name what is wanted: a lobe matches when all of its own are among them.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct BxdfFlags: u8 {
        /// Light stays on the side it came from.
        const REFLECTION = 1;
        /// Light goes through to the other side.
        const TRANSMISSION = 2;
        /// Spread over all directions.
        const DIFFUSE = 4;
        /// Spread around one direction.
        const GLOSSY = 8;
        /// One direction alone: a delta distribution.
        const SPECULAR = 16;
    }
}

/// A direction drawn from a lobe: one event of scattering.
///
/// It is made by the constructor that names how the event spreads light, so that its flags are those of
/// the event and never those of the whole lobe: [`diffuse`](Self::diffuse), [`glossy`](Self::glossy) or
/// [`specular`](Self::specular), each of which reflects unless [`transmitted`](Self::transmitted) follows.
/// [`Bsdf`](super::Bsdf) looks again: on which side an event is follows from `wo` and `wi`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct BxdfSample {
    /// The value for the pair of directions, without the cosine, in 1/sr. For a delta lobe, the value
    /// that makes f |cos θi| / pdf the share of light that goes this way.
    pub f: Spectrum,
    /// The direction that light comes from, a unit vector.
    pub wi: Vec3,
    /// Density over solid angle, above 0; of a specular event its probability.
    pub pdf: f32,
    /// What happened: one of `REFLECTION` and `TRANSMISSION`, and one of `DIFFUSE`, `GLOSSY` and
    /// `SPECULAR`.
    pub flags: BxdfFlags,
    /// The relative index of refraction that the path crossed from `wo` to `wi`: the index on the side of
    /// `wi` over that on the side of `wo`; 1 for a reflection. Russian roulette asks for it.
    pub eta: f32,
}

impl BxdfSample {
    /// A reflection into all directions, drawn with the density `pdf` over solid angle.
    #[inline]
    pub const fn diffuse(f: Spectrum, wi: Vec3, pdf: f32) -> Self {
        Self::reflected(f, wi, pdf, BxdfFlags::DIFFUSE)
    }

    /// A reflection around one direction, drawn with the density `pdf` over solid angle.
    #[inline]
    pub const fn glossy(f: Spectrum, wi: Vec3, pdf: f32) -> Self {
        Self::reflected(f, wi, pdf, BxdfFlags::GLOSSY)
    }

    /// A reflection into one direction alone, chosen with this probability.
    #[inline]
    pub const fn specular(f: Spectrum, wi: Vec3, probability: f32) -> Self {
        Self::reflected(f, wi, probability, BxdfFlags::SPECULAR)
    }

    /// The same as an event of transmission, over a boundary with this relative index of refraction: see
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

    /// Whether the direction is the only one that this event has.
    #[inline]
    pub const fn is_specular(&self) -> bool {
        self.flags.contains(BxdfFlags::SPECULAR)
    }
}

/// One lobe of reflection, of transmission, or of both: how much of the light that comes from `wi` leaves
/// along `wo`.
///
/// All directions are unit vectors in shading coordinates, away from the surface; `wo.z` is not 0 (see
/// [`Bsdf`](super::Bsdf), which sees to it). A model implements `flags` and `f`; the defaults sample
/// cosine-weighted directions and estimate the reflectances by Monte Carlo. Paths run from the camera to
/// the lights and carry radiance, so a lobe that refracts includes the factor of 1/η² in `f`.
///
/// ```
/// use lobe::Spectrum;
/// use lobe::bxdf::{BxDF, BxdfFlags};
/// use lobe::glam::{Vec2, Vec3};
///
/// /// Reflects half of the light, but only back to where it came from in azimuth.
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
/// assert!(HalfMoon.matches(BxdfFlags::all()) && !HalfMoon.matches(BxdfFlags::REFLECTION));
/// ```
///
/// A lobe with two events, which `uc` chooses between:
///
/// ```
/// use lobe::Spectrum;
/// use lobe::bxdf::{BxDF, BxdfFlags, BxdfSample};
/// use lobe::glam::{Vec2, Vec3};
///
/// /// A half-silvered window: reflects 30 % of the light like a mirror, and lets 70 % pass.
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
pub trait BxDF: Send + Sync {
    /// What kind of lobe this is.
    fn flags(&self) -> BxdfFlags;

    /// The value for a pair of directions, without the cosine, in 1/sr: finite and not negative. It
    /// does not ask on which side of the surface they lie: [`Bsdf`](super::Bsdf) has decided that.
    /// A delta lobe returns black.
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum;

    /// A direction `wi` for `wo`, drawn with the density [`pdf`](BxDF::pdf), or `None` when this lobe has
    /// none for these samples. `uc` in `[0, 1)` chooses between the events that the lobe has, `u` in
    /// `[0, 1)²` the direction; both are uniform and independent.
    #[inline]
    fn sample_f(&self, wo: Vec3, _uc: f32, u: Vec2) -> Option<BxdfSample> {
        let mut wi = cosine_hemisphere::sample(u);
        if wo.z < 0.0 {
            wi.z = -wi.z;
        }
        let pdf = self.pdf(wo, wi);
        (pdf > 0.0).then(|| {
            let f = self.f(wo, wi);
            match self.flags().contains(BxdfFlags::GLOSSY) {
                true => BxdfSample::glossy(f, wi, pdf),
                false => BxdfSample::diffuse(f, wi, pdf),
            }
        })
    }

    /// Density over solid angle with which `sample_f` gives `wi`; 0 for a delta lobe.
    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if same_hemisphere(wo, wi) { cosine_hemisphere::pdf(abs_cos_theta(wi)) } else { 0.0 }
    }

    /// Whether `sample_f` looks at `uc`. A lobe that answers false spares its surface one sample value for
    /// each hit, and is handed NaN.
    #[inline]
    fn uses_uc(&self) -> bool {
        true
    }

    /// About how much of a uniform light leaves along `wo`, in `[0, 1]`: the larger, the more often a
    /// [`Bsdf`](super::Bsdf) of several lobes draws this one. It need not be exact, since values and
    /// densities agree for any estimate; what is out of range is brought into it. The default treats all
    /// lobes alike.
    #[inline]
    fn albedo_estimate(&self, _wo: Vec3) -> f32 {
        1.0
    }

    /// Hemispherical-directional reflectance ρ_hd: the share of a uniform light from all sides that
    /// leaves along `wo`, in `[0, 1]` per band (PBRT 3rd edition, section 8.1.1).
    ///
    /// The default is the Monte Carlo mean of f |cos θi| / pdf over the samples `uc` and `u` of
    /// [`sample_f`](BxDF::sample_f). The longer slice is cut to the length of the shorter.
    fn rho_hd(&self, wo: Vec3, uc: &[f32], u: &[Vec2]) -> Spectrum {
        let estimate = |(&uc, &u): (&f32, &Vec2)| throughput(self.sample_f(wo, uc, u));
        mean(uc.iter().zip(u).filter_map(estimate), uc.len().min(u.len()))
    }

    /// Hemispherical-hemispherical reflectance ρ_hh: the share of a uniform light from all sides that
    /// leaves again, in `[0, 1]` per band.
    ///
    /// The default is a Monte Carlo mean over triples of samples: `u1` for wo, uniform over the
    /// hemisphere, `uc` and `u2` for wi. The longer slices are cut to the length of the shortest.
    fn rho_hh(&self, u1: &[Vec2], uc: &[f32], u2: &[Vec2]) -> Spectrum {
        let estimate = |((&u1, &uc), &u2): ((&Vec2, &f32), &Vec2)| {
            let wo = uniform_hemisphere::sample(u1);
            // 1/π ∫ ρ_hd cos θo dωo, by the density of wo.
            let weight = abs_cos_theta(wo) / (std::f32::consts::PI * uniform_hemisphere::pdf());
            let sample = (wo.z != 0.0).then(|| self.sample_f(wo, uc, u2)).flatten();
            throughput(sample).map(|t| t * weight)
        };
        let count = u1.len().min(uc.len()).min(u2.len());
        mean(u1.iter().zip(uc).zip(u2).filter_map(estimate), count)
    }

    /// Whether this lobe is among the kinds that `wanted` names.
    #[inline]
    fn matches(&self, wanted: BxdfFlags) -> bool {
        wanted.contains(self.flags())
    }
}

/// The sum over `count`, or black for a count of 0. In f64: the error of a long sum of f32 shows.
fn mean(estimates: impl Iterator<Item = Spectrum>, count: usize) -> Spectrum {
    let sum = estimates.fold(DVec3::ZERO, |sum, s| sum + Vec3::from(s.to_array()).as_dvec3());
    (sum / count.max(1) as f64).as_vec3().into()
}

/// f |cos θi| / pdf.
fn throughput(sample: Option<BxdfSample>) -> Option<Spectrum> {
    sample.map(|s| s.f * (abs_cos_theta(s.wi) / s.pdf))
}
