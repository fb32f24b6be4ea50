//! [`Bsdf`]: the sum of lobes at a hit.

use std::cell::Cell;

use arrayvec::ArrayVec;
use glam::{Vec2, Vec3};

use super::shares::Shares;
use super::{BxDF, BxdfFlags, BxdfSample, Lobe, MAX_LOBES};
use crate::geometry::Frame;
use crate::interaction::SurfaceInteraction;
use crate::simd::Float;
use crate::spectrum::Spectrum;

/// The bidirectional scattering distribution function at one point: a sum of lobes, evaluated in world space
/// (PBRT 3rd edition, section 9.1).
///
/// It converts between world and shading coordinates, and checks everything that lobes return, so that no
/// lobe has to:
/// - Lobes see shading coordinates only. The shading frame is also the source of every cosine of this
///   surface: [`abs_cos_theta`](Bsdf::abs_cos_theta).
/// - Shading coordinates follow the shading normal, but the **geometric** normal decides whether light is
///   reflected or transmitted. So no light leaks through a surface whose shading normal is tilted.
///   Pairs of directions for which the two normals disagree are black, except for delta lobes. Lobes never
///   sample a direction above the surface and below the shading plane, so only light sampling would find
///   those, and the two strategies would not agree.
/// - No lobe is called with a `wo` exactly parallel to the surface.
/// - Whether a sample is a reflection or a transmission follows from its directions, not from the lobe's
///   flags; only a transmission keeps its relative index `eta`.
/// - Every value returned is finite and non-negative. Invalid results of lobes are counted in
///   [`rejected`](Bsdf::rejected).
///
/// ```
/// use lobe::Spectrum;
/// use lobe::bxdf::{Bsdf, BxdfFlags, LambertianReflection};
/// use lobe::geometry::Frame;
/// use lobe::glam::{Vec2, Vec3};
///
/// let normal = Vec3::Y;
/// let mut bsdf = Bsdf::new(Frame::from_normal(normal), normal);
/// bsdf.add(LambertianReflection::new(Spectrum::splat(0.5)));
///
/// let wo = Vec3::new(0.6, 0.8, 0.0);
/// let sample = bsdf.sample_f(wo, 0.5, Vec2::new(0.3, 0.7), BxdfFlags::all()).unwrap();
/// assert!(sample.wi.dot(normal) > 0.0);
/// assert_eq!(bsdf.f(wo, -sample.wi, BxdfFlags::all()), Spectrum::BLACK);
/// ```
#[derive(Clone)]
#[doc(alias = "bxdf")]
#[doc(alias = "scattering")]
pub struct Bsdf<'a> {
    frame: Frame,
    ng: Vec3,
    terms: ArrayVec<Term<'a>, MAX_LOBES>,
    rejected: Cell<u32>,
}

/// One term of the sum.
#[derive(Clone, Copy)]
struct Term<'a> {
    lobe: Lobe<'a>,
    scale: Spectrum,
    /// Those of the lobe, cached so that lobes of other kinds are skipped without a call.
    flags: BxdfFlags,
}

impl<'a> Bsdf<'a> {
    /// A surface without lobes, which absorbs all light, in the given shading frame.
    ///
    /// The z axis of `frame` is the shading normal, and `ng` is the unit geometric normal. A frame that is not
    /// orthonormal to 1e-3 would not conserve energy: it is replaced by [`Frame::from_normal`] of `ng`, and
    /// counted as rejected.
    pub fn new(frame: Frame, ng: Vec3) -> Self {
        let mut bsdf = Self::in_frame(frame, ng);
        if !frame.is_orthonormal() {
            bsdf.reject();
            bsdf.frame = Frame::from_normal(ng.normalize_or(Vec3::Z));
        }
        bsdf
    }

    /// A surface without lobes. The frame follows the shading normal and its tangents are arbitrary: for
    /// isotropic lobes.
    #[inline]
    pub fn isotropic(si: &SurfaceInteraction) -> Self {
        Self::in_frame(Frame::from_normal(si.shading_n()), si.n())
    }

    /// A surface without lobes. The frame follows the shading normal and its x axis follows ∂p/∂u: for
    /// anisotropic lobes.
    pub fn along_u(si: &SurfaceInteraction) -> Self {
        let tangent = si.shading().dpdu;
        Self::in_frame(Frame::from_normal_and_tangent(si.shading_n(), tangent), si.n())
    }

    #[inline]
    fn in_frame(frame: Frame, ng: Vec3) -> Self {
        Self { frame, ng, terms: ArrayVec::new_const(), rejected: Cell::new(0) }
    }

    /// Adds a lobe: one of this crate's by value, any other by reference. A material lends a lobe that it holds
    /// (`bsdf.add(&self.lobe as &dyn BxDF)`), or puts one that it makes for this hit, and which is `Copy`, into the
    /// arena that it is given (`bsdf.add(arena.lobe(Mine { r }))`).
    ///
    /// Returns false if all [`MAX_LOBES`] are in use: the lobe is then left out and counted as
    /// rejected.
    #[inline]
    pub fn add(&mut self, lobe: impl Into<Lobe<'a>>) -> bool {
        self.add_scaled(lobe, Spectrum::WHITE)
    }

    /// [Adds](Self::add) a lobe whose values are multiplied by `scale`. In `[0, 1]` per band, it conserves energy if the lobe does.
    #[inline]
    pub fn add_scaled(&mut self, lobe: impl Into<Lobe<'a>>, scale: Spectrum) -> bool {
        let lobe = lobe.into();
        let added = self.terms.try_push(Term { lobe, scale, flags: lobe.flags() }).is_ok();
        if !added {
            self.reject();
        }
        added
    }

    /// The lobes of two surfaces, scaled by weights in `[0, 1]`, in the frame of the first. If its tangents are arbitrary and both have the
    /// same normal, they are those of the second.
    pub(crate) fn mixed(&self, weight: f32, other: &Self, other_weight: f32) -> Self {
        let of_normal = Frame::from_normal(self.frame.n);
        let frame = match self.frame == of_normal && other.frame.n == self.frame.n {
            true => other.frame,
            false => self.frame,
        };
        let rejected = Cell::new(self.rejected() + other.rejected());
        let mut bsdf = Self { rejected, ..Self::in_frame(frame, self.ng) };
        for (terms, weight) in [(&self.terms, weight), (&other.terms, other_weight)] {
            for &Term { lobe, scale, .. } in terms {
                bsdf.add_scaled(lobe, scale * weight);
            }
        }
        bsdf
    }

    /// The shading frame.
    #[inline]
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// |cos θ| between a world direction and the shading normal: the factor that [`f`](Bsdf::f) leaves out.
    #[inline]
    pub fn abs_cos_theta(&self, w: Vec3) -> f32 {
        w.dot(self.frame.n).abs()
    }

    /// Number of errors since construction: a frame that was not orthonormal, lobes that did not fit, transmissions
    /// without an index, and results of lobes that were dropped or replaced by black because they were negative, not
    /// finite, or on a side that the lobe's flags exclude.
    pub fn rejected(&self) -> u32 {
        self.rejected.get()
    }

    /// Flags of all lobes together.
    pub(crate) fn all_flags(&self) -> BxdfFlags {
        self.terms.iter().fold(BxdfFlags::empty(), |all, term| all | term.flags)
    }

    /// Whether all lobes are specular: light samples, which are given directions, find nothing.
    #[inline]
    pub(super) fn is_specular(&self) -> bool {
        let spread = BxdfFlags::DIFFUSE | BxdfFlags::GLOSSY;
        self.terms.iter().all(|term| !term.flags.intersects(spread))
    }

    /// All lobes, in the order in which they were added, each with its scale.
    pub fn lobes(&self) -> impl ExactSizeIterator<Item = (&Lobe<'a>, Spectrum)> {
        self.terms.iter().map(|term| (&term.lobe, term.scale))
    }

    /// Number of lobes whose flags are all contained in `flags`.
    #[inline]
    pub fn num_components(&self, flags: BxdfFlags) -> usize {
        self.matching(flags).count()
    }

    /// Whether [`sample_f`](Bsdf::sample_f) uses `uc`: if there are several lobes, or one that uses it.
    #[inline]
    pub fn uses_uc(&self) -> bool {
        match &self.terms[..] {
            [] => false,
            [term] => term.lobe.uses_uc(),
            _ => true,
        }
    }

    /// Value for a pair of world directions, without the cosine, in 1/sr: the sum over the lobes that match
    /// `flags`. Delta lobes contribute nothing.
    #[inline]
    pub fn f(&self, wo: Vec3, wi: Vec3, flags: BxdfFlags) -> Spectrum {
        let local_wo = self.frame.to_local(wo);
        if local_wo.z == 0.0 {
            return Spectrum::BLACK;
        }
        let local = [local_wo, self.frame.to_local(wi)];
        let side = self.side([wo, wi], local);
        let on_side = self.matching(flags).filter(|term| term.flags.intersects(side));
        self.guarded(on_side.map(|term| term.scale * term.lobe.f(local[0], local[1])).sum())
    }

    /// Samples a world direction `wi`. One of the lobes that match `flags` is selected with a probability
    /// that grows with its [`BxDF::albedo_estimate`]. `uc` in `[0, 1)` selects the lobe and its event, `u` in
    /// `[0, 1)²` the direction.
    ///
    /// `f` and `pdf` of the sample are those of all matching lobes together, unless the event is specular.
    /// `None` if no lobe matches, if the selected one returns no sample, or if the sample's direction is not finite or
    /// its density is 0 or invalid.
    pub fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2, flags: BxdfFlags) -> Option<BxdfSample> {
        let local_wo = self.frame.to_local(wo);
        if local_wo.z == 0.0 {
            return None;
        }
        let shares = self.shares(local_wo, flags);
        let (chosen, uc) = shares.choose(uc);
        let term = self.matching(flags).nth(chosen)?;
        let mut sample = term.sample_f(local_wo, uc, u)?;
        let local_wi = sample.wi;
        sample.wi = self.frame.to_world(local_wi);
        if !sample.wi.is_finite() {
            self.reject();
            return None;
        }
        self.correct_event(&mut sample, term.flags, local_wo.z, local_wi.z);
        sample.pdf *= shares.of(chosen);
        if !sample.is_specular() {
            let local = [local_wo, local_wi];
            let side = self.side([wo, sample.wi], local);
            if !term.flags.intersects(side) {
                sample.f = Spectrum::BLACK;
            }
            for (i, other) in self.matching(flags).enumerate().filter(|(i, _)| *i != chosen) {
                let (f, pdf) = other.f_and_pdf(local, side);
                sample.f += f;
                sample.pdf += shares.of(i) * pdf;
            }
        }
        if !sample.is_specular() && !term.flags.intersects(sample.flags & SIDES) {
            self.reject();
        }
        if self.guarded_pdf(sample.pdf) == 0.0 {
            return None;
        }
        sample.f = self.guarded(sample.f);
        Some(sample)
    }

    /// Density over solid angle with which [`sample_f`](Bsdf::sample_f) returns `wi`: the mean of the
    /// matching lobes' densities, weighted by their selection probabilities.
    #[inline]
    pub fn pdf(&self, wo: Vec3, wi: Vec3, flags: BxdfFlags) -> f32 {
        let local = [wo, wi].map(|w| self.frame.to_local(w));
        if local[0].z == 0.0 {
            return 0.0;
        }
        let shares = self.shares(local[0], flags);
        let of_terms = self.matching(flags).enumerate();
        self.guarded_pdf(
            of_terms.map(|(i, term)| shares.of(i) * term.lobe.pdf(local[0], local[1])).sum(),
        )
    }

    /// [`f`](Bsdf::f) and [`pdf`](Bsdf::pdf) together.
    #[inline]
    pub fn f_and_pdf(&self, wo: Vec3, wi: Vec3, flags: BxdfFlags) -> (Spectrum, f32) {
        let local = [wo, wi].map(|w| self.frame.to_local(w));
        if local[0].z == 0.0 {
            return (Spectrum::BLACK, 0.0);
        }
        let (side, shares) = (self.side([wo, wi], local), self.shares(local[0], flags));
        let (mut f, mut mean_pdf) = (Spectrum::BLACK, 0.0);
        for (i, term) in self.matching(flags).enumerate() {
            let (of_term, pdf) = term.f_and_pdf(local, side);
            f += of_term;
            mean_pdf += shares.of(i) * pdf;
        }
        (self.guarded(f), self.guarded_pdf(mean_pdf))
    }

    /// Fraction of uniform incident light that is scattered along the world direction `wo`: see [`BxDF::rho_hd`].
    #[inline]
    pub fn rho_hd(&self, wo: Vec3, uc: &[f32], u: &[Vec2], flags: BxdfFlags) -> Spectrum {
        let wo = self.frame.to_local(wo);
        if wo.z == 0.0 {
            return Spectrum::BLACK;
        }
        self.guarded(
            self.matching(flags).map(|term| term.scale * term.lobe.rho_hd(wo, uc, u)).sum(),
        )
    }

    /// Fraction of uniform incident light that is scattered at all: see [`BxDF::rho_hh`].
    pub fn rho_hh(&self, u1: &[Vec2], uc: &[f32], u2: &[Vec2], flags: BxdfFlags) -> Spectrum {
        self.guarded(
            self.matching(flags).map(|term| term.scale * term.lobe.rho_hh(u1, uc, u2)).sum(),
        )
    }

    /// Makes a sample's flags consistent: its side follows from its directions, only a transmission has an
    /// index, and if the lobe has a single kind of spread (diffuse, glossy or specular), so do its samples.
    #[inline]
    fn correct_event(&self, sample: &mut BxdfSample, kind: BxdfFlags, wo_z: f32, wi_z: f32) {
        let reflects = (wo_z > 0.0) == (wi_z > 0.0);
        let side = if reflects { BxdfFlags::REFLECTION } else { BxdfFlags::TRANSMISSION };
        let spread = match kind - SIDES {
            only if only.bits().is_power_of_two() && !sample.is_specular() => {
                // A specular lobe without sampling of its own cannot find its direction.
                if only == BxdfFlags::SPECULAR && sample.f.is_black() {
                    self.reject();
                }
                only
            }
            _ => sample.flags - SIDES,
        };
        let claimed = sample.flags;
        sample.flags = side | spread;
        if reflects {
            sample.eta = 1.0;
        } else if !(sample.eta > 0.0 && sample.eta < f32::INFINITY && claimed.contains(side)) {
            // An index of 1 only makes Russian roulette noisier; the estimate stays unbiased.
            self.reject();
            sample.eta = 1.0;
        }
    }

    /// Whether a pair of directions is a reflection or a transmission; empty if the geometric and the shading
    /// normal disagree.
    #[inline]
    fn side(&self, [wo, wi]: [Vec3; 2], local: [Vec3; 2]) -> BxdfFlags {
        match sides([wo.dot(self.ng), wi.dot(self.ng)], local.map(|w| w.z)) {
            [true, _] => BxdfFlags::REFLECTION,
            [_, true] => BxdfFlags::TRANSMISSION,
            _ => BxdfFlags::empty(),
        }
    }

    /// Whether the tangents are arbitrary and the geometric normal is `ng`: then lobes are all that there is to know.
    #[inline(always)]
    pub(super) fn is_plain(&self, ng: Vec3) -> bool {
        self.frame == Frame::from_normal(self.frame.n) && self.ng == ng && self.rejected() == 0
    }

    /// Selection probability of each lobe that matches `flags`, for a local direction.
    #[inline]
    fn shares(&self, wo: Vec3, flags: BxdfFlags) -> Shares {
        if self.num_components(flags) < 2 {
            return Shares::All;
        }
        let estimates = self.matching(flags).map(|term| term.albedo_estimate(wo));
        Shares::new(estimates.collect())
    }

    /// The terms whose lobes match `flags`.
    #[inline]
    fn matching(&self, flags: BxdfFlags) -> impl Iterator<Item = &Term<'a>> {
        self.terms.iter().filter(move |term| flags.contains(term.flags))
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

impl Term<'_> {
    #[inline]
    fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample> {
        self.lobe
            .sample_f(wo, uc, u)
            .map(|sample| BxdfSample { f: self.scale * sample.f, ..sample })
    }

    /// Value, if the lobe scatters light to this side, and density.
    #[inline]
    fn f_and_pdf(&self, [wo, wi]: [Vec3; 2], side: BxdfFlags) -> (Spectrum, f32) {
        if !self.flags.intersects(side) {
            return (Spectrum::BLACK, self.lobe.pdf(wo, wi));
        }
        let (f, pdf) = self.lobe.f_and_pdf(wo, wi);
        (self.scale * f, pdf)
    }

    #[inline]
    fn albedo_estimate(&self, wo: Vec3) -> f32 {
        self.scale.max_component() * self.lobe.albedo_estimate(wo)
    }
}

/// Whether pairs of directions are reflections, and whether they are transmissions, from their cosines with the geometric
/// normal and with the shading normal. Neither, if the normals disagree.
#[inline(always)]
pub(super) fn sides<F: Float>(with_ng: [F; 2], with_ns: [F; 2]) -> [F::Mask; 2] {
    let (ng, ns) = (signs_differ(with_ng), signs_differ(with_ns));
    [!(ng | ns), ng & ns]
}

#[inline(always)]
fn signs_differ<F: Float>([a, b]: [F; 2]) -> F::Mask {
    a.gt(F::splat(0.0)) ^ b.gt(F::splat(0.0))
}

const SIDES: BxdfFlags = BxdfFlags::REFLECTION.union(BxdfFlags::TRANSMISSION);
