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

/// What travels along a path: it decides on a factor of eta² at refracting boundaries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TransportMode {
    /// The path began at the camera and gathers radiance.
    #[default]
    Radiance,
    /// The path began at a light and carries importance.
    Importance,
}

/// A direction drawn from a lobe. Its pdf is never 0: there would be no such sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BxdfSample {
    /// The value for the pair of directions, without the cosine, in 1/sr. For a delta lobe, the value
    /// that makes f |cos θi| / pdf the share of light that goes this way.
    pub f: Spectrum,
    /// The direction that light comes from.
    pub wi: Vec3,
    /// Density over solid angle; for a delta lobe the probability of its choice.
    pub pdf: f32,
    /// The flags of the lobe that was drawn from.
    pub flags: BxdfFlags,
}

/// One lobe of reflection or transmission: how much of the light that comes from `wi` leaves along `wo`.
///
/// All directions are unit vectors in shading coordinates, away from the surface; `wo.z` is not 0 (see
/// [`Bsdf`](super::Bsdf), which sees to it). A model implements `flags` and `f`; the defaults sample
/// cosine-weighted directions and estimate the reflectances by Monte Carlo.
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
/// let sample = HalfMoon.sample_f(wo, Vec2::new(0.9, 0.6)).unwrap();
/// assert_eq!(sample.pdf, HalfMoon.pdf(wo, sample.wi));
/// assert_eq!(sample.f, HalfMoon.f(wo, sample.wi));
/// assert!(HalfMoon.matches(BxdfFlags::all()) && !HalfMoon.matches(BxdfFlags::REFLECTION));
/// ```
pub trait BxDF: Send + Sync {
    /// What kind of lobe this is.
    fn flags(&self) -> BxdfFlags;

    /// The value for a pair of directions, without the cosine, in 1/sr: finite and not negative. It
    /// does not ask on which side of the surface they lie: [`Bsdf`](super::Bsdf) has decided that.
    /// A delta lobe returns black.
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum;

    /// A direction `wi` for `wo`, drawn with the density [`pdf`](BxDF::pdf), or `None` when this
    /// lobe has none for this `u` in `[0, 1)²`.
    #[inline]
    fn sample_f(&self, wo: Vec3, u: Vec2) -> Option<BxdfSample> {
        let mut wi = cosine_hemisphere::sample(u);
        if wo.z < 0.0 {
            wi.z = -wi.z;
        }
        let pdf = self.pdf(wo, wi);
        (pdf > 0.0).then(|| BxdfSample { f: self.f(wo, wi), wi, pdf, flags: self.flags() })
    }

    /// Density over solid angle with which `sample_f` gives `wi`; 0 for a delta lobe.
    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if same_hemisphere(wo, wi) { cosine_hemisphere::pdf(abs_cos_theta(wi)) } else { 0.0 }
    }

    /// Hemispherical-directional reflectance ρ_hd: the share of a uniform light from all sides that
    /// leaves along `wo`, in `[0, 1]` per band (PBRT 3rd edition, section 8.1.1).
    ///
    /// The default is the Monte Carlo mean of f |cos θi| / pdf over the points `u` in `[0, 1)²`.
    fn rho_hd(&self, wo: Vec3, u: &[Vec2]) -> Spectrum {
        mean(u.iter().filter_map(|&u| throughput(self.sample_f(wo, u))), u.len())
    }

    /// Hemispherical-hemispherical reflectance ρ_hh: the share of a uniform light from all sides that
    /// leaves again, in `[0, 1]` per band.
    ///
    /// The default is a Monte Carlo mean over pairs of points: `u1` for wo, uniform over the
    /// hemisphere, `u2` for wi. The longer slice is cut to the length of the shorter.
    fn rho_hh(&self, u1: &[Vec2], u2: &[Vec2]) -> Spectrum {
        let estimate = |(&u1, &u2)| {
            let wo = uniform_hemisphere::sample(u1);
            // 1/π ∫ ρ_hd cos θo dωo, by the density of wo.
            let weight = abs_cos_theta(wo) / (std::f32::consts::PI * uniform_hemisphere::pdf());
            (wo.z != 0.0).then(|| throughput(self.sample_f(wo, u2)).map(|t| t * weight)).flatten()
        };
        mean(u1.iter().zip(u2).filter_map(estimate), u1.len().min(u2.len()))
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
