//! [`BsdfBlock`]: the lobes at a block of hits.

use arrayvec::ArrayVec;
use bytemuck::Zeroable;
use glam::Vec2;

use super::bsdf::sides;
use super::wide_lobe::{MOST_NUMBERS, Model, WideLobe, of_model};
use super::{Bsdf, BxdfFlags, LambertianReflection, WideBxdf};
use crate::geometry::{Axes, Xyz};
use crate::interaction::{HitBlock, Hits, SurfaceInteraction};
use crate::simd::{Block, BlockKernel, LaneMask, ROW, Row, Rows, groups, lanes_within};
use crate::spectrum::Bands;

/// The lobes at a block of hits: what a [`Bsdf`] is for one.
///
/// Where all hits have one lobe of the same model of this crate, or a coat and its base, as they do on most materials, the lobes are kept as
/// rows of numbers and evaluated several at a time. Otherwise a [`Bsdf`] is kept for each hit. Both give the same bits.
pub struct BsdfBlock<'a> {
    /// The model of all lobes; `None` if `each` has what there is.
    model: Option<Model<'a>>,
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
        let mut has_black = false;
        let mut lobe_at = |i: usize| {
            let bsdf = bsdf_at(i, &mut hits.get(i));
            normals.set(i, bsdf.frame().n.to_array());
            bsdf
        };
        for i in 0..self.len {
            let bsdf = lobe_at(i);
            let is_black = bsdf.lobes().len() == 0;
            has_black |= is_black;
            let is_wide = bsdf.is_plain(hits.ng(i))
                && match WideLobe::of(&bsdf) {
                    Some(lobe) => (!has_black || lobe.model.has_black()) && self.set(i, lobe),
                    None => is_black && self.set_black(i),
                };
            if !is_wide {
                self.model = None;
                self.each.extend((0..i).map(&mut lobe_at));
                self.each.push(bsdf);
                self.each.extend((i + 1..hits.len()).map(&mut lobe_at));
                break;
            }
        }
        if self.each.is_empty() {
            // If all hits are black, any model will do.
            self.model.get_or_insert(WideLobe::from(LambertianReflection::BLACK).model);
        }
        hits.shading_n = normals;
    }

    /// Replaces the lobes by one for each hit, of the same model, in the shading frames of the hits. False if they are not alike: then there are
    /// none.
    #[inline]
    pub(crate) fn fill_alike<L>(&mut self, hits: &HitBlock, lobe_at: impl Fn(usize) -> L) -> bool
    where
        L: TryInto<WideLobe<'a>>,
    {
        self.clear();
        for i in 0..hits.len() {
            let Ok(lobe) = lobe_at(i).try_into() else { return false };
            if !self.set(i, lobe) {
                self.model = None;
                return false;
            }
        }
        self.len = hits.len();
        true
    }

    /// Replaces the lobes by the same one for each hit, in the shading frames of the hits.
    #[inline]
    pub(crate) fn fill_constant(&mut self, hits: &HitBlock, lobe: impl Into<WideLobe<'a>>) {
        self.clear();
        self.len = hits.len();
        let WideLobe { model, numbers } = lobe.into();
        self.model = Some(model);
        for (row, number) in self.numbers.iter_mut().zip(numbers) {
            *row = Row::splat(number);
        }
    }

    /// Keeps the lobe at a hit. False if it is of another model than those before.
    #[inline(always)]
    fn set(&mut self, i: usize, WideLobe { model, numbers }: WideLobe<'a>) -> bool {
        if self.model.is_some_and(|known| known != model) {
            return false;
        }
        self.model = Some(model);
        self.set_numbers(i, numbers);
        true
    }

    /// Keeps a black lobe at a hit, if lobes before have a model with one.
    #[inline(always)]
    fn set_black(&mut self, i: usize) -> bool {
        self.set_numbers(i, [0.0; MOST_NUMBERS]);
        self.model.is_none_or(Model::has_black)
    }

    #[inline(always)]
    fn set_numbers(&mut self, i: usize, numbers: [f32; MOST_NUMBERS]) {
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
        of_model!(model, model => {
            let numbers = first(numbers);
            *rejected +=
                set.run_block(Evaluate { model, hits, numbers, wi, asked, needs_pdf, f, pdf });
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
        let mut of_each = Row::splat(f32::NAN);
        if of_model!(model, model => model.uses_uc()) {
            uc(of_each.first_mut(self.len));
        }
        of_model!(model, model => {
            let (numbers, uc) = (first(numbers), &of_each);
            *rejected += set.run_block(Sample { model, hits, numbers, uc, u, samples });
        });
    }

    /// Takes the number of [rejected](Bsdf::rejected) results.
    pub(crate) fn take_rejected(&mut self) -> u64 {
        let of_each: u32 = self.each.iter().map(Bsdf::rejected).sum();
        u64::from(std::mem::take(&mut self.rejected) + of_each)
    }
}

/// Those rows that a model has.
#[inline(always)]
fn first<const N: usize>(numbers: &[Row; MOST_NUMBERS]) -> &[Row; N] {
    const { assert!(N <= MOST_NUMBERS) };
    numbers.first_chunk().expect("a model has at most as many numbers")
}

/// The lobes in the lanes from `at` on.
#[inline(always)]
fn load<F: Block, const N: usize>(numbers: &[Row; N], at: usize) -> [F; N] {
    let mut lobes = [F::splat(0.0); N];
    for (lobe, row) in lobes.iter_mut().zip(numbers) {
        *lobe = row.load(at);
    }
    lobes
}

struct Evaluate<'a, M, const N: usize> {
    model: M,
    hits: &'a HitBlock<'a>,
    numbers: &'a [Row; N],
    wi: &'a Rows<3>,
    asked: &'a Row,
    needs_pdf: &'a Row,
    f: &'a mut Rows<3>,
    pdf: &'a mut Row,
}

impl<M: WideBxdf<N>, const N: usize> BlockKernel for Evaluate<'_, M, N> {
    type Output = u32;

    #[inline(always)]
    fn run<F: Block>(self) -> u32 {
        let Self { model, hits, numbers, wi: all_wi, asked, needs_pdf, f: all_f, pdf: all_pdf } =
            self;
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
            let values = model.f_and_pdf(lobes, local[0], local[1]);
            let (f, pdf, invalid) = guarded(values, &of_hits, wi, local, needed);
            rejected += count(invalid, lanes_within::<F>(at, len));
            all_f.store(at, f.0);
            all_pdf.store(at, pdf);
        }
        rejected
    }
}

struct Sample<'a, M, const N: usize> {
    model: M,
    hits: &'a HitBlock<'a>,
    numbers: &'a [Row; N],
    uc: &'a Row,
    u: &'a [Vec2; ROW],
    samples: &'a mut BsdfSamples,
}

impl<M: WideBxdf<N>, const N: usize> BlockKernel for Sample<'_, M, N> {
    type Output = u32;

    #[inline(always)]
    fn run<F: Block>(self) -> u32 {
        let Self { model, hits, numbers, uc, u, samples } = self;
        let BsdfSamples { f: all_f, wi: all_wi, pdf: all_pdf, .. } = samples;
        let (len, zero) = (hits.len(), F::splat(0.0));
        let mut rejected = 0;
        for at in groups::<F>(len) {
            let of_hits = hits.load::<F>(at);
            let axes = Axes::from_normal(of_hits.shading_n);
            let local_wo = axes.to_local(of_hits.wo);
            let lobes = load::<F, N>(numbers, at);
            let (uc, u) = (uc.load(at), F::load_pairs(&u[at..]));
            let local_wi = model.sample(lobes, local_wo, uc, u);
            let (local, wi) = ([local_wo, local_wi], axes.to_world(local_wi));
            let (f, pdf) = model.f_and_pdf(lobes, local_wo, local_wi);
            let exists = !local_wo.z.eq(zero) & pdf.gt(zero);
            let (f, pdf, invalid) = guarded((f, pdf), &of_hits, wi, local, [exists; 2]);
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
