//! [`BsdfBlock`]: the lobes at a block of hits.

use std::marker::PhantomData;

use arrayvec::ArrayVec;
use bytemuck::Zeroable;
use glam::{Vec2, Vec3};

use super::bsdf::sides;
use super::lobe::{MOST_NUMBERS, Model, of_model};
use super::{Bsdf, BxdfFlags, Lobe, WideBxdf};
use crate::geometry::{Axes, Xyz};
use crate::interaction::{HitBlock, Hits, SurfaceInteraction};
use crate::simd::{Block, BlockKernel, LaneMask, ROW, Row, Rows, groups, lanes_within};
use crate::spectrum::Bands;

/// The lobes at a block of hits: what a [`Bsdf`] is for one.
///
/// Where all hits have one lobe of the same model of this crate, as they do on most materials, the lobes are kept as rows of
/// numbers and evaluated several at a time. Otherwise a [`Bsdf`] is kept for each hit. Both give the same bits.
pub struct BsdfBlock<'a> {
    /// The model of all lobes; `None` if `each` has what there is.
    model: Option<Model>,
    numbers: [Row; MOST_NUMBERS],
    each: ArrayVec<Bsdf<'a>, ROW>,
    len: usize,
    rejected: u32,
}

/// Directions drawn at a block of hits: see [`BxdfSample`](super::BxdfSample).
#[derive(Zeroable)]
pub(crate) struct BsdfSamples {
    pub f: Rows<3>,
    pub wi: Rows<3>,
    /// 0 where there is no sample.
    pub pdf: Row,
    /// Whether the event is specular: 1 or 0.
    pub is_specular: Row,
    pub eta: Row,
}

impl<'a> BsdfBlock<'a> {
    /// No lobes.
    pub(crate) fn new() -> Self {
        let numbers = [Row::splat(0.0); MOST_NUMBERS];
        Self { model: None, numbers, each: ArrayVec::new(), len: 0, rejected: 0 }
    }

    /// Removes the lobes.
    pub(crate) fn clear(&mut self) {
        self.len = 0;
        self.model = None;
        self.each.clear();
    }

    /// Number of hits whose lobes it has.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// Takes the lobes that `bsdf_at` returns for each hit and its index, and replaces the shading normals of the hits by those
    /// of their frames. `bsdf_at` may replace the shading geometry of a hit, and may be called twice for it.
    ///
    /// # Panics
    /// If the block has lobes already: their frames would be taken for the surface's.
    #[inline]
    pub fn fill(
        &mut self,
        hits: &mut HitBlock,
        bsdf_at: impl Fn(usize, &mut SurfaceInteraction) -> Bsdf<'a>,
    ) {
        assert_eq!(self.len, 0, "a material fills a block of lobes once");
        self.len = hits.len();
        let mut normals = Rows::splat(0.0);
        let mut lobe_at = |i: usize| {
            let bsdf = bsdf_at(i, &mut hits.get(i));
            normals.set(i, bsdf.frame().n.to_array());
            bsdf
        };
        for i in 0..self.len {
            let bsdf = lobe_at(i);
            if !self.set_only_lobe(i, hits.ng(i), &bsdf) {
                self.model = None;
                self.each.extend((0..i).map(&mut lobe_at));
                self.each.push(bsdf);
                self.each.extend((i + 1..hits.len()).map(&mut lobe_at));
                break;
            }
        }
        if self.each.is_empty() {
            // If all hits are black, any model will do.
            self.model.get_or_insert(Model::LambertianReflection);
        }
        hits.shading_n = normals;
    }

    /// Replaces the lobes by one for each hit, of the same model, in the shading frames of the hits.
    #[inline]
    pub(crate) fn fill_alike<M, const N: usize>(
        &mut self,
        hits: &HitBlock,
        lobe_at: impl Fn(usize) -> M,
    ) where
        M: WideBxdf<N> + Into<Lobe<'a>>,
    {
        self.clear();
        self.len = hits.len();
        for i in 0..self.len {
            if let Some((model, numbers)) = lobe_at(i).into().numbers() {
                self.model = Some(model);
                self.set(i, numbers);
            }
        }
    }

    /// Replaces the lobes by the same one for each hit, in the shading frames of the hits.
    #[inline]
    pub(crate) fn fill_constant<M, const N: usize>(&mut self, hits: &HitBlock, lobe: M)
    where
        M: WideBxdf<N> + Into<Lobe<'a>>,
    {
        self.clear();
        self.len = hits.len();
        if let Some((model, numbers)) = lobe.into().numbers() {
            self.model = Some(model);
            for (row, number) in self.numbers.iter_mut().zip(numbers) {
                *row = Row::splat(number);
            }
        }
    }

    /// Keeps the only lobe at a hit as numbers, if that is possible. No lobe is one of zeros, which is black in any model.
    #[inline(always)]
    fn set_only_lobe(&mut self, i: usize, ng: Vec3, bsdf: &Bsdf<'a>) -> bool {
        let Some(lobe) = bsdf.only_lobe(ng) else { return false };
        let Some(lobe) = lobe else {
            self.set(i, [0.0; MOST_NUMBERS]);
            return true;
        };
        match lobe.numbers() {
            Some((model, numbers)) if self.model.is_none_or(|known| known == model) => {
                self.model = Some(model);
                self.set(i, numbers);
                true
            }
            _ => false,
        }
    }

    #[inline(always)]
    fn set(&mut self, i: usize, numbers: [f32; MOST_NUMBERS]) {
        for (row, number) in self.numbers.iter_mut().zip(numbers) {
            row.set(i, number);
        }
    }

    /// Whether all lobes are specular: light samples, which are given directions, find nothing.
    pub(crate) fn is_specular(&self) -> bool {
        self.model.is_none() && self.each.iter().all(Bsdf::is_specular)
    }

    /// [`Bsdf::f_and_pdf`] of all lobes, for the world direction `wi` of each hit where `asked` is not 0. `pdf` is valid only
    /// where `needs_pdf` is above 0 too.
    #[inline]
    pub(crate) fn f_and_pdf(
        &mut self,
        hits: &HitBlock,
        wi: &Rows<3>,
        [asked, needs_pdf]: [&Row; 2],
        f: &mut Rows<3>,
        pdf: &mut Row,
    ) {
        let Some(model) = self.model else {
            for (i, bsdf) in self.each.iter().enumerate().filter(|(i, _)| asked.get(*i) != 0.0) {
                let (wo, wi, all) = (hits.wo(i), wi.get(i).into(), BxdfFlags::all());
                let value = if needs_pdf.get(i) > 0.0 {
                    let (value, density) = bsdf.f_and_pdf(wo, wi, all);
                    pdf.set(i, density);
                    value
                } else {
                    bsdf.f(wo, wi, all)
                };
                f.set(i, value.to_array());
            }
            return;
        };
        let set = hits.instruction_set;
        let Self { numbers, rejected, .. } = self;
        of_model!(model, M => {
            *rejected += set.run_block(Evaluate::<M, _> { hits, numbers, wi, asked, needs_pdf, f, pdf, model: PhantomData });
        });
    }

    /// [`Bsdf::sample_f`] at each hit. `uc` is asked for that number of each hit, if any uses it.
    #[inline]
    pub(crate) fn sample_f(
        &mut self,
        hits: &HitBlock,
        uc: impl FnOnce(&mut [f32]),
        u: &[Vec2; ROW],
        samples: &mut BsdfSamples,
    ) {
        let Some(model) = self.model else {
            let mut of_each = [f32::NAN; ROW];
            if self.each.iter().any(Bsdf::uses_uc) {
                uc(&mut of_each[..self.len]);
            }
            for (i, (bsdf, (&uc, &u))) in self.each.iter().zip(of_each.iter().zip(u)).enumerate() {
                samples.pdf.set(i, 0.0);
                if let Some(sample) = bsdf.sample_f(hits.wo(i), uc, u, BxdfFlags::all()) {
                    samples.f.set(i, sample.f.to_array());
                    samples.wi.set(i, sample.wi.to_array());
                    samples.pdf.set(i, sample.pdf);
                    samples.is_specular.set(i, f32::from(sample.is_specular()));
                    samples.eta.set(i, sample.eta);
                }
            }
            return;
        };
        let set = hits.instruction_set;
        let Self { numbers, rejected, .. } = self;
        (samples.is_specular, samples.eta) = (Row::splat(0.0), Row::splat(1.0));
        of_model!(model, M => {
            *rejected += set.run_block(Sample::<M, _> { hits, numbers, u, samples, model: PhantomData });
        });
    }

    /// Takes the number of [rejected](Bsdf::rejected) results.
    pub(crate) fn take_rejected(&mut self) -> u64 {
        let of_each: u32 = self.each.iter().map(Bsdf::rejected).sum();
        u64::from(std::mem::take(&mut self.rejected) + of_each)
    }
}

/// The lobes in the lanes from `at` on.
#[inline(always)]
fn load<F: Block, const N: usize>(numbers: &[Row; MOST_NUMBERS], at: usize) -> [F; N] {
    let mut lobes = [F::splat(0.0); N];
    for (lobe, row) in lobes.iter_mut().zip(numbers) {
        *lobe = row.load(at);
    }
    lobes
}

struct Evaluate<'a, M, const N: usize> {
    hits: &'a HitBlock<'a>,
    numbers: &'a [Row; MOST_NUMBERS],
    wi: &'a Rows<3>,
    asked: &'a Row,
    needs_pdf: &'a Row,
    f: &'a mut Rows<3>,
    pdf: &'a mut Row,
    model: PhantomData<[M; N]>,
}

impl<M: WideBxdf<N>, const N: usize> BlockKernel for Evaluate<'_, M, N> {
    type Output = u32;

    #[inline(always)]
    fn run<F: Block>(self) -> u32 {
        let Self { hits, numbers, wi: all_wi, asked, needs_pdf, f: all_f, pdf: all_pdf, .. } = self;
        let (len, zero) = (hits.len(), F::splat(0.0));
        let mut rejected = 0;
        for at in groups::<F>(len) {
            let of_hits = hits.load::<F>(at);
            let wi = all_wi.load(at).into();
            let axes = Axes::from_normal(of_hits.shading_n);
            let local = [axes.to_local(of_hits.wo), axes.to_local(wi)];
            let lobes = load::<F, N>(numbers, at);
            let exists = !local[0].z.eq(zero) & !asked.load::<F>(at).eq(zero);
            let needed = [exists, exists & needs_pdf.load::<F>(at).gt(zero)];
            let values = (M::f(lobes, local[0], local[1]), M::pdf(lobes, local[0], local[1]));
            let (f, pdf, invalid) = guarded(values, &of_hits, wi, local, needed);
            rejected += count(invalid, lanes_within::<F>(at, len));
            all_f.store(at, f.0);
            all_pdf.store(at, pdf);
        }
        rejected
    }
}

struct Sample<'a, M, const N: usize> {
    hits: &'a HitBlock<'a>,
    numbers: &'a [Row; MOST_NUMBERS],
    u: &'a [Vec2; ROW],
    samples: &'a mut BsdfSamples,
    model: PhantomData<[M; N]>,
}

impl<M: WideBxdf<N>, const N: usize> BlockKernel for Sample<'_, M, N> {
    type Output = u32;

    #[inline(always)]
    fn run<F: Block>(self) -> u32 {
        let Self { hits, numbers, u, samples, .. } = self;
        let BsdfSamples { f: all_f, wi: all_wi, pdf: all_pdf, .. } = samples;
        let (len, zero) = (hits.len(), F::splat(0.0));
        let mut rejected = 0;
        for at in groups::<F>(len) {
            let of_hits = hits.load::<F>(at);
            let axes = Axes::from_normal(of_hits.shading_n);
            let local_wo = axes.to_local(of_hits.wo);
            let lobes = load::<F, N>(numbers, at);
            let local_wi = M::sample(lobes, local_wo, F::load_pairs(&u[at..]));
            let (local, wi) = ([local_wo, local_wi], axes.to_world(local_wi));
            let pdf = M::pdf(lobes, local_wo, local_wi);
            let exists = !local_wo.z.eq(zero) & pdf.gt(zero);
            let values = (M::f(lobes, local_wo, local_wi), pdf);
            let (f, pdf, invalid) = guarded(values, &of_hits, wi, local, [exists; 2]);
            rejected += count(invalid, lanes_within::<F>(at, len));
            all_f.store(at, f.0);
            all_wi.store(at, wi.into());
            all_pdf.store(at, pdf);
        }
        rejected
    }
}

/// The guard of [`Bsdf`] for lobes that reflect: values and densities of pairs of directions, 0 where they are not needed, on the
/// wrong side or invalid; and where they are invalid.
#[inline(always)]
fn guarded<F: Block>(
    (f, pdf): (Bands<F>, F),
    hits: &Hits<F>,
    wi: Xyz<F>,
    [local_wo, local_wi]: [Xyz<F>; 2],
    [needs_f, needs_pdf]: [F::Mask; 2],
) -> (Bands<F>, F, [F::Mask; 2]) {
    let [reflects, _] = sides([hits.wo.dot(hits.n), wi.dot(hits.n)], [local_wo.z, local_wi.z]);
    let zero = F::splat(0.0);
    let f = f.only(reflects & needs_f);
    let pdf = F::select(needs_pdf, pdf, zero);
    let (f_valid, pdf_valid) = (f.is_valid(), zero.le(pdf) & pdf.lt(F::splat(f32::INFINITY)));
    (f.only(f_valid), F::select(pdf_valid, pdf, zero), [!f_valid, !pdf_valid])
}

/// Number of lanes in two masks.
#[inline(always)]
fn count<M: LaneMask>([a, b]: [M; 2], within: u32) -> u32 {
    (a.bits() & within).count_ones() + (b.bits() & within).count_ones()
}
