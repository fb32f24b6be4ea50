//! [`SobolSampler`]: Owen-scrambled Sobol points.

use glam::Vec2;

use super::hash::{hash, mix};
use super::owen::{
    BLOCK, scramble, shuffle_block, shuffle_within_block, unit_float_reversed as unit,
};
use super::sequence::{FIRST_PAIRS, pair};
use super::{Make, SampleId, Sampler, SamplerKind};
use crate::params::Kind;

/// Owen-scrambled Sobol points: a progressive low-discrepancy sequence, evenly distributed at any
/// number of samples.
///
/// A set has up to 2³² samples; its size need not be known in advance. In every dimension, any 2ᵏ
/// samples whose first index is a multiple of 2ᵏ are a (0, k, 2)-net: one point in each box of size
/// 2⁻ᵃ × 2⁻ᵏ⁺ᵃ, for every a, down to the 2⁻²⁴ that a float resolves. Other numbers of samples are
/// unbiased too, but less even.
///
/// Dimensions d and d + 2, where d mod 4 is 0 or 1, form a *couple* that is stratified jointly in
/// 4D: 4ᵏ aligned samples have one point in each box whose four sides are powers of 1/4 with
/// product 4⁻ᵏ. Couples, pixels and sets are scrambled and shuffled independently. In one
/// dimension, the error of smooth integrands falls almost as n⁻¹·⁵.
///
/// Points of a couple: Ahmed 2024, "SZ Sequences". Scrambling and shuffling by hashing: [Burley
/// 2020], "Practical Hash-based Owen Scrambling", sections 3 and 4.
///
/// [Burley 2020]: https://jcgt.org/published/0009/04/01/
///
/// ```
/// use lobe::glam::UVec2;
/// use lobe::sampling::{SampleId, Sampler, SobolSampler};
///
/// // Four samples have one point in each quarter of the square.
/// let sampler = SobolSampler::new(0);
/// let mut quarters = [0; 4];
/// for index in 0..4 {
///     let p = sampler.get_2d(SampleId { pixel: UVec2::new(3, 7), set: 0, index }, 0);
///     quarters[(p.x * 2.0) as usize + 2 * (p.y * 2.0) as usize] += 1;
/// }
/// assert_eq!(quarters, [1; 4]);
/// ```
#[doc(alias = "low-discrepancy")]
#[doc(alias = "quasi-monte carlo")]
#[derive(Clone, Copy, Debug)]
pub struct SobolSampler {
    /// Seed of the scrambles of coordinates.
    value_seed: u64,
    /// Seed of the shuffles of sample order.
    order_seed: u64,
}

impl SobolSampler {
    /// Different seeds give different images.
    pub fn new(seed: u64) -> Self {
        Self { value_seed: mix(seed), order_seed: mix(!seed) }
    }

    /// The value of each id, written over the contents of `values`.
    #[inline]
    pub(super) fn fill_1d_of(
        &self,
        ids: impl Iterator<Item = SampleId>,
        dimension: u32,
        values: &mut Vec<f32>,
    ) {
        values.clear();
        let mut block: Option<Block> = None;
        values.extend(ids.map(|id| {
            let block = Block::cached(&mut block, self, id, dimension);
            unit(scramble(block.point(id.index)[0].into(), block.seeds[0]) as u32)
        }));
    }

    /// The point of each id, written over the contents of `points`.
    #[inline]
    pub(super) fn fill_2d_of(
        &self,
        mut ids: impl ExactSizeIterator<Item = SampleId>,
        dimension: u32,
        points: &mut Vec<Vec2>,
    ) {
        points.clear();
        let mut block: Option<Block> = None;
        let mut lanes = Lanes::default();
        while ids.len() > 0 {
            let count = ids.len().min(LANES);
            for (lane, id) in ids.by_ref().take(count).enumerate() {
                let block = Block::cached(&mut block, self, id, dimension);
                let [x, y] = block.point(id.index);
                (lanes.x[lane], lanes.y[lane]) = (x.into(), y.into());
                [lanes.x_seeds[lane], lanes.y_seeds[lane]] = block.seeds;
            }
            points.extend_from_slice(&lanes.scrambled()[..count]);
        }
    }
}

impl Sampler for SobolSampler {
    fn is_correlated(&self) -> bool {
        KIND.read.is_correlated
    }

    #[inline]
    fn get_1d(&self, id: SampleId, dimension: u32) -> f32 {
        let block = Block::new(self, id, dimension);
        unit(scramble(block.point(id.index)[0].into(), block.seeds[0]) as u32)
    }

    #[inline]
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2 {
        let block = Block::new(self, id, dimension);
        let [x, y] = block.point(id.index);
        let [x, y] = [scramble(x.into(), block.seeds[0]), scramble(y.into(), block.seeds[1])];
        Vec2::new(unit(x as u32), unit(y as u32))
    }

    fn fill_1d(&self, ids: &[SampleId], dimension: u32, values: &mut Vec<f32>) {
        self.fill_1d_of(ids.iter().copied(), dimension, values);
    }

    fn fill_2d(&self, ids: &[SampleId], dimension: u32, points: &mut Vec<Vec2>) {
        self.fill_2d_of(ids.iter().copied(), dimension, points);
    }
}

/// The index of the couple that `dimension` belongs to, and which half of the couple it is.
#[inline]
pub(super) fn couple(dimension: u32) -> (u32, u32) {
    (dimension >> 2 << 1 | dimension & 1, dimension >> 1 & 1)
}

/// What an aligned block of [`BLOCK`] samples has in common in one dimension.
struct Block {
    /// Id of the first sample.
    first: SampleId,
    /// Seeds of the scrambles of x and y.
    seeds: [u64; 2],
    /// Random bits of the shuffle within the block.
    coins: u32,
    /// x and y of the shuffled block's first point, not scrambled yet, bit-reversed.
    base: [u32; 2],
    /// Which half of its couple the dimension is.
    half: u32,
}

impl Block {
    #[inline(never)]
    fn new(sampler: &SobolSampler, id: SampleId, dimension: u32) -> Self {
        let first = SampleId { index: id.index & !(BLOCK - 1), ..id };
        let (couple, half) = couple(dimension);
        let set = SampleId { index: 0, ..id };
        let seeds = hash(sampler.value_seed, set, dimension);
        let order = hash(sampler.order_seed, set, couple);
        Self {
            first,
            seeds: [seeds >> 32, seeds & u64::from(u32::MAX)],
            coins: mix(order ^ u64::from(first.index)) as u32,
            base: pair(shuffle_block(id.index, (order >> 32) as u32), half),
            half,
        }
    }

    /// The block of `id`: the cached one if it holds `id`, otherwise a new one, which replaces it.
    #[inline(always)]
    fn cached<'a>(
        cache: &'a mut Option<Self>,
        sampler: &SobolSampler,
        id: SampleId,
        dimension: u32,
    ) -> &'a Self {
        let first = SampleId { index: id.index & !(BLOCK - 1), ..id };
        if cache.as_ref().is_none_or(|block| block.first != first) {
            *cache = Some(Self::new(sampler, id, dimension));
        }
        cache.as_ref().expect("the cache was filled above")
    }

    /// x and y of a sample of the block before scrambling, bit-reversed.
    #[inline]
    fn point(&self, index: u32) -> [u32; 2] {
        let within = shuffle_within_block(index, self.coins);
        let [x, y] = FIRST_PAIRS[self.half as usize][within];
        [self.base[0] ^ x, self.base[1] ^ y]
    }
}

/// Points that are scrambled together, so that the compiler vectorises the loop.
const LANES: usize = 16;

/// Structure of arrays of bit-reversed points and the seeds of their scrambles.
#[derive(Default)]
struct Lanes {
    x: [u64; LANES],
    y: [u64; LANES],
    x_seeds: [u64; LANES],
    y_seeds: [u64; LANES],
}

impl Lanes {
    #[inline(never)]
    fn scrambled(&self) -> [Vec2; LANES] {
        let (mut x, mut y) = ([0_u32; LANES], [0_u32; LANES]);
        for i in 0..LANES {
            x[i] = scramble(self.x[i], self.x_seeds[i]) as u32;
            y[i] = scramble(self.y[i], self.y_seeds[i]) as u32;
        }
        std::array::from_fn(|i| Vec2::new(unit(x[i]), unit(y[i])))
    }
}

impl SamplerKind {
    /// [`SobolSampler`].
    pub const SOBOL: Self = Self(&KIND);
}

/// `type = "sobol"`
pub(super) const KIND: Kind<Make> = Kind {
    name: "sobol",
    meaning: "Owen-scrambled Sobol points",
    keys: &[],
    read: Make { is_correlated: true, make: |sets| Box::new(SobolSampler::new(sets.seed)) },
};
