//! [`SobolSampler`]: Owen-scrambled Sobol points.

use glam::Vec2;

use super::hash::{hash, mix};
use super::owen::{
    BLOCK, scramble, shuffle_block, shuffle_within_block, unit_float_reversed as unit,
};
use super::sequence::pair;
use super::wide::{IdBlock, Lanes, Seeds, WIDTH, WideSampler};
use super::{Make, SampleId, Sampler, SamplerKind};
use crate::params::Kind;
use crate::simd::InstructionSet;

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
    instruction_set: InstructionSet,
}

impl SobolSampler {
    /// Different seeds give different images.
    pub fn new(seed: u64) -> Self {
        let instruction_set = InstructionSet::fastest();
        Self { value_seed: mix(seed), order_seed: mix(!seed), instruction_set }
    }

    /// Other instructions than the fastest, for measuring and tests.
    pub fn with_instruction_set(self, instruction_set: InstructionSet) -> Self {
        Self { instruction_set, ..self }
    }
}

impl Sampler for SobolSampler {
    fn is_correlated(&self) -> bool {
        KIND.read.is_correlated
    }

    #[inline]
    fn get_1d(&self, id: SampleId, dimension: u32) -> f32 {
        self.get_2d(id, dimension).x
    }

    #[inline]
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2 {
        let [values, order] = self.seeds(id, dimension);
        let [x, y] = point(id.index, (order >> 32) as u32, coins(id.index, order), dimension);
        let [x, y] = [scramble(x, (values >> 32) as u32), scramble(y, values as u32)];
        Vec2::new(unit(x), unit(y))
    }

    fn fill_1d(&self, ids: &[SampleId], dimension: u32, values: &mut [f32]) {
        self.fill_values(ids, dimension, values);
    }

    fn fill_2d(&self, ids: &[SampleId], dimension: u32, points: &mut [Vec2]) {
        self.fill_points(ids, dimension, points);
    }
}

impl Seeds for SobolSampler {
    /// Those of the scrambles of coordinates, and of the shuffle.
    #[inline(always)]
    fn seeds(&self, id: SampleId, dimension: u32) -> [u64; 2] {
        let set = SampleId { index: 0, ..id };
        let values = hash(self.value_seed, set, dimension);
        [values, hash(self.order_seed, set, couple(dimension).0)]
    }
}

impl WideSampler for SobolSampler {
    fn instruction_set(&self) -> InstructionSet {
        self.instruction_set
    }

    #[inline(always)]
    fn block<const D: usize>(&self, ids: &IdBlock, dimension: u32) -> [Lanes<f32>; D] {
        let [values, orders] = ids.seeds(self, dimension);
        let mut seeds = [[0; WIDTH]; 2];
        let (mut order_seeds, mut all_coins) = ([0; WIDTH], [0; WIDTH]);
        for i in 0..WIDTH {
            (seeds[0][i], seeds[1][i]) = ((values[i] >> 32) as u32, values[i] as u32);
            order_seeds[i] = (orders[i] >> 32) as u32;
            all_coins[i] = coins(ids.index[i], orders[i]);
        }
        let mut rows = [[0.0; WIDTH]; D];
        for i in 0..WIDTH {
            let p = point(ids.index[i], order_seeds[i], all_coins[i], dimension);
            for ((row, x), seeds) in rows.iter_mut().zip(p).zip(&seeds) {
                row[i] = unit(scramble(x, seeds[i]));
            }
        }
        rows
    }
}

/// Random bits of the shuffle within the sample's block. `order` is the seed of its set.
#[inline(always)]
fn coins(index: u32, order: u64) -> u32 {
    mix(order ^ u64::from(index & !(BLOCK - 1))) as u32
}

/// x and y of a sample before scrambling, bit-reversed.
#[inline(always)]
fn point(index: u32, order_seed: u32, coins: u32, dimension: u32) -> [u32; 2] {
    let shuffled = shuffle_block(index, order_seed) | shuffle_within_block(index, coins);
    pair(shuffled, couple(dimension).1)
}

/// The index of the couple that `dimension` belongs to, and which half of the couple it is.
#[inline(always)]
pub(super) fn couple(dimension: u32) -> (u32, u32) {
    (dimension >> 2 << 1 | dimension & 1, dimension >> 1 & 1)
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
