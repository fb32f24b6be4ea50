//! [`Bsdf`]: the sum of lobes at a hit.

use std::cell::Cell;

use arrayvec::ArrayVec;
use glam::{Vec2, Vec3};

use super::{BxDF, BxdfFlags, BxdfSample, LambertianReflection, Lobe};
use crate::geometry::Frame;
use crate::geometry::float::ONE_MINUS_EPSILON;
use crate::spectrum::Spectrum;

/// The most lobes that one [`Bsdf`] holds (PBRT's `MaxBxDFs`).
pub const MAX_LOBES: usize = 8;

/// How a surface scatters light at one point: a sum of lobes, asked and answered in world space.
///
/// It stands between the world and the lobes, and is their one guard:
/// - world directions go in, shading coordinates reach the lobes;
/// - the shading normal makes the coordinates, but the **geometric** normal decides whether light is
///   reflected or transmitted, so that none leaks through a surface whose shading normal leans over
///   (PBRT 3rd edition, section 9.1); directions for which the two normals disagree are black (but for
///   delta lobes): above the surface and below the shading plane no lobe draws any, and light sampling alone would count them;
/// - no lobe is asked about a `wo` that lies exactly along the surface;
/// - nothing leaves it that is not finite and non-negative. What a lobe gave instead is counted in
///   [`rejected`](Bsdf::rejected).
///
/// ```
/// use lobe::Spectrum;
/// use lobe::bxdf::{Bsdf, BxdfFlags, LambertianReflection};
/// use lobe::geometry::Frame;
/// use lobe::glam::{Vec2, Vec3};
///
/// let normal = Vec3::Y;
/// let mut bsdf = Bsdf::new(Frame::from_normal(normal), normal, 1.0);
/// bsdf.add(LambertianReflection::new(Spectrum::splat(0.5)));
///
/// let wo = Vec3::new(0.6, 0.8, 0.0);
/// let sample = bsdf.sample_f(wo, Vec2::new(0.3, 0.7), BxdfFlags::all()).unwrap();
/// assert!(sample.wi.dot(normal) > 0.0);
/// assert_eq!(bsdf.f(wo, -sample.wi, BxdfFlags::all()), Spectrum::BLACK);
/// ```
#[derive(Clone)]
pub struct Bsdf<'a> {
    frame: Frame,
    ng: Vec3,
    eta: f32,
    /// Each lobe with its kind, so that a question need not ask the lobes that it is not for.
    lobes: ArrayVec<(Lobe<'a>, BxdfFlags), MAX_LOBES>,
    rejected: Cell<u32>,
}

impl<'a> Bsdf<'a> {
    /// A surface without lobes: it absorbs everything.
    ///
    /// `frame` is made from the shading normal, `ng` is the unit geometric normal, and `eta` is the
    /// relative index of refraction over the boundary, 1 for what light does not pass.
    #[inline]
    pub fn new(frame: Frame, ng: Vec3, eta: f32) -> Self {
        Self { frame, ng, eta, lobes: ArrayVec::new_const(), rejected: Cell::new(0) }
    }

    /// Adds a lobe. Returns whether there was room for it: a ninth lobe is left out, and counted as
    /// rejected.
    #[inline]
    pub fn add(&mut self, lobe: impl Into<Lobe<'a>>) -> bool {
        let lobe = lobe.into();
        let added = self.lobes.try_push((lobe, lobe.flags())).is_ok();
        if !added {
            self.reject();
        }
        added
    }

    /// The shading frame.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The relative index of refraction.
    pub fn eta(&self) -> f32 {
        self.eta
    }

    /// How many lobes found no room, and how many answers of lobes were left out, or turned into black,
    /// because they were negative or not finite.
    pub fn rejected(&self) -> u32 {
        self.rejected.get()
    }

    /// How many lobes are among the kinds that `flags` names.
    #[inline]
    pub fn num_components(&self, flags: BxdfFlags) -> usize {
        self.matching(flags).count()
    }

    /// The value for a pair of world directions, without the cosine, in 1/sr: the sum of the lobes of
    /// the kinds in `flags`. Delta lobes add nothing.
    #[inline]
    pub fn f(&self, wo: Vec3, wi: Vec3, flags: BxdfFlags) -> Spectrum {
        if let Some(lobe) = self.only_lambertian(flags) {
            let [wo_z, wi_z] = [wo, wi].map(|w| w.dot(self.frame.n));
            let reflects =
                wo_z != 0.0 && self.side([wo, wi], [wo_z, wi_z]) == BxdfFlags::REFLECTION;
            return if reflects { self.guarded(lobe.f(wo, wi)) } else { Spectrum::BLACK };
        }
        let local_wo = self.frame.to_local(wo);
        if local_wo.z == 0.0 {
            return Spectrum::BLACK;
        }
        let f = self.sum([wo, wi], [local_wo, self.frame.to_local(wi)], flags);
        self.guarded(f)
    }

    /// A world direction `wi` drawn from one of the lobes of the kinds in `flags`, each equally likely.
    ///
    /// `f` and `pdf` of the sample are those of all these lobes together, unless the chosen one is a
    /// delta lobe. `None` when no lobe matches, or when the chosen one has no direction for this `u`.
    pub fn sample_f(&self, wo: Vec3, u: Vec2, flags: BxdfFlags) -> Option<BxdfSample> {
        if let Some(lobe) = self.only_lambertian(flags) {
            let local_wo = Vec3::Z * wo.dot(self.frame.n);
            if local_wo.z == 0.0 {
                return None;
            }
            let mut sample = lobe.sample_f(local_wo, u)?;
            let wi_z = sample.wi.z;
            sample.wi = self.frame.to_world(sample.wi);
            if self.side([wo, sample.wi], [local_wo.z, wi_z]) != BxdfFlags::REFLECTION {
                sample.f = Spectrum::BLACK;
            }
            sample.f = self.guarded(sample.f);
            return Some(sample);
        }
        let matching = self.num_components(flags);
        let local_wo = self.frame.to_local(wo);
        if matching == 0 || local_wo.z == 0.0 {
            return None;
        }
        // Choose which lobe to sample, and stretch what is left of u.x over [0, 1) again.
        let scaled = u.x * matching as f32;
        let chosen = (scaled as usize).min(matching - 1);
        let (lobe, kind) = self.matching(flags).nth(chosen)?;
        let u = Vec2::new((scaled - chosen as f32).min(ONE_MINUS_EPSILON), u.y);
        let mut sample = lobe.sample_f(local_wo, u)?;
        let local_wi = sample.wi;
        sample.wi = self.frame.to_world(local_wi);
        let specular = kind.contains(BxdfFlags::SPECULAR);
        if specular {
            sample.pdf /= matching as f32;
        } else if matching > 1 {
            sample.pdf = self.mean_pdf(local_wo, local_wi, flags);
        }
        if !sample.wi.is_finite() {
            self.reject();
            return None;
        }
        if self.guarded_pdf(sample.pdf) == 0.0 {
            return None;
        }
        if !specular {
            if matching > 1 {
                sample.f = self.sum([wo, sample.wi], [local_wo, local_wi], flags);
            } else if !kind.intersects(self.side([wo, sample.wi], [local_wo.z, local_wi.z])) {
                sample.f = Spectrum::BLACK;
            }
        }
        sample.f = self.guarded(sample.f);
        Some(sample)
    }

    /// Density over solid angle with which [`sample_f`](Bsdf::sample_f) gives `wi`: the mean over the
    /// lobes of the kinds in `flags`.
    #[inline]
    pub fn pdf(&self, wo: Vec3, wi: Vec3, flags: BxdfFlags) -> f32 {
        let local_wo = self.frame.to_local(wo);
        if local_wo.z == 0.0 {
            return 0.0;
        }
        self.guarded_pdf(self.mean_pdf(local_wo, self.frame.to_local(wi), flags))
    }

    /// [`f`](Bsdf::f) and [`pdf`](Bsdf::pdf) in one go.
    #[inline]
    pub fn f_and_pdf(&self, wo: Vec3, wi: Vec3, flags: BxdfFlags) -> (Spectrum, f32) {
        if let Some(lobe) = self.only_lambertian(flags) {
            let [local_wo, local_wi] = [wo, wi].map(|w| Vec3::Z * w.dot(self.frame.n));
            return (self.f(wo, wi, flags), lobe.pdf(local_wo, local_wi));
        }
        let (local_wo, local_wi) = (self.frame.to_local(wo), self.frame.to_local(wi));
        if local_wo.z == 0.0 {
            return (Spectrum::BLACK, 0.0);
        }
        let f = self.sum([wo, wi], [local_wo, local_wi], flags);
        (self.guarded(f), self.guarded_pdf(self.mean_pdf(local_wo, local_wi, flags)))
    }

    /// The share of a uniform light that leaves along the world direction `wo`: see [`BxDF::rho_hd`].
    pub fn rho_hd(&self, wo: Vec3, u: &[Vec2], flags: BxdfFlags) -> Spectrum {
        let wo = self.frame.to_local(wo);
        if wo.z == 0.0 {
            return Spectrum::BLACK;
        }
        self.guarded(self.matching(flags).map(|(lobe, _)| lobe.rho_hd(wo, u)).sum())
    }

    /// The share of a uniform light that leaves at all: see [`BxDF::rho_hh`].
    pub fn rho_hh(&self, u1: &[Vec2], u2: &[Vec2], flags: BxdfFlags) -> Spectrum {
        self.guarded(self.matching(flags).map(|(lobe, _)| lobe.rho_hh(u1, u2)).sum())
    }

    /// The lobe of a plain diffuse surface, the most common by far, which looks at no more of a direction than
    /// on which side it lies, and how high.
    #[inline]
    fn only_lambertian(&self, flags: BxdfFlags) -> Option<&LambertianReflection> {
        match &self.lobes[..] {
            [(Lobe::Lambertian(lobe), kind)] if flags.contains(*kind) => Some(lobe),
            _ => None,
        }
    }

    /// Reflection or transmission of a pair of world directions, whose heights over the plane of the shading normal are
    /// `z`; neither if the two normals disagree.
    #[inline]
    fn side(&self, [wo, wi]: [Vec3; 2], z: [f32; 2]) -> BxdfFlags {
        let reflects = (wi.dot(self.ng) > 0.0) == (wo.dot(self.ng) > 0.0);
        match (reflects, (z[0] > 0.0) == (z[1] > 0.0)) {
            (true, true) => BxdfFlags::REFLECTION,
            (false, false) => BxdfFlags::TRANSMISSION,
            _ => BxdfFlags::empty(),
        }
    }

    /// The lobes' values for a pair of directions in the world, which are `local` in shading coordinates.
    #[inline]
    fn sum(&self, world: [Vec3; 2], local: [Vec3; 2], flags: BxdfFlags) -> Spectrum {
        let side = self.side(world, local.map(|w| w.z));
        let [wo, wi] = local;
        let mut f = Spectrum::BLACK;
        for (lobe, kind) in self.matching(flags) {
            if kind.intersects(side) {
                f += lobe.f(wo, wi);
            }
        }
        f
    }

    #[inline]
    fn mean_pdf(&self, wo: Vec3, wi: Vec3, flags: BxdfFlags) -> f32 {
        let (mut sum, mut count) = (0.0, 0);
        for (lobe, _) in self.matching(flags) {
            sum += lobe.pdf(wo, wi);
            count += 1;
        }
        if count > 1 { sum / count as f32 } else { sum }
    }

    /// The lobes of the kinds in `flags`, each with its kind.
    #[inline]
    fn matching(&self, flags: BxdfFlags) -> impl Iterator<Item = (&Lobe<'a>, BxdfFlags)> {
        self.lobes
            .iter()
            .map(|(lobe, kind)| (lobe, *kind))
            .filter(move |&(_, kind)| flags.contains(kind))
    }

    #[inline]
    fn guarded(&self, f: Spectrum) -> Spectrum {
        if f.is_valid() {
            return f;
        }
        self.reject();
        Spectrum::BLACK
    }

    #[inline]
    fn guarded_pdf(&self, pdf: f32) -> f32 {
        if (0.0..f32::INFINITY).contains(&pdf) {
            return pdf;
        }
        self.reject();
        0.0
    }

    #[cold]
    fn reject(&self) {
        self.rejected.set(self.rejected.get() + 1);
    }
}
