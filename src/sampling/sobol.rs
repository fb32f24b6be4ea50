//! [`SobolSampler`]: Owen-scrambled points of low discrepancy.

use glam::Vec2;

use super::hash::{hash, mix};
use super::owen::{
    BLOCK, scramble, shuffle_block, shuffle_within_block, unit_float_reversed as unit,
};
use super::sequence::{FIRST_PAIRS, pair};
use super::{Make, SampleId, Sampler, SamplerKind};
use crate::params::Kind;

/// Owen-scrambled Sobol points: wherever a set ends, what was taken is spread evenly.
///
/// A set has up to 2³² samples and does not know of its size. Any 2ᵏ samples whose first index is a multiple of 2ᵏ
/// have exactly one point in each of the 2ᵏ boxes of any shape 2⁻ᵃ × 2⁻ᵏ⁺ᵃ, in every dimension, down to the 2⁻²⁴
/// that a float resolves. Sizes that are no power of two are unbiased too, but less even.
///
/// Dimensions d and d + 2, where d mod 4 is 0 or 1, are spread together: 4ᵏ samples, aligned, have one in each box
/// whose four sides are powers of 1/4 with product 4⁻ᵏ. Each such couple is scrambled and shuffled on its own, as
/// is each pixel and each set. In one dimension, the error of smooth integrands falls almost with n⁻¹·⁵.
///
/// Points of the couple: Ahmed 2024, "SZ Sequences"; scramble and shuffle by hashing: [Burley 2020], "Practical
/// Hash-based Owen Scrambling", sections 3 and 4.
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
#[derive(Clone, Copy, Debug)]
pub struct SobolSampler {
    /// For the scrambles.
    value_seed: u64,
    /// For the order of samples.
    order_seed: u64,
}

impl SobolSampler {
    /// Each seed gives another image.
    pub fn new(seed: u64) -> Self {
        Self { value_seed: mix(seed), order_seed: mix(!seed) }
    }

    /// The numbers of these samples, in place of what `values` holds.
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
            let block = Block::go_on(&mut block, self, id, dimension);
            unit(scramble(block.place(id.index)[0].into(), block.seeds[0]) as u32)
        }));
    }

    /// The points of these samples, in place of what `points` holds.
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
                let block = Block::go_on(&mut block, self, id, dimension);
                let [x, y] = block.place(id.index);
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
        unit(scramble(block.place(id.index)[0].into(), block.seeds[0]) as u32)
    }

    #[inline]
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2 {
        let block = Block::new(self, id, dimension);
        let [x, y] = block.place(id.index);
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

/// The couple that a dimension belongs to, and which of its halves it is.
#[inline]
pub(super) fn couple(dimension: u32) -> (u32, u32) {
    (dimension >> 2 << 1 | dimension & 1, dimension >> 1 & 1)
}

/// What an aligned block of samples shares in one dimension.
struct Block {
    /// The first sample.
    first: SampleId,
    /// For the scrambles of both coordinates.
    seeds: [u64; 2],
    /// For the order within the block.
    coins: u32,
    /// Both coordinates of the block's first place in the sequence, with bits in reverse.
    base: [u32; 2],
    half: u32,
}

impl Block {
    #[inline]
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

    /// The block of this sample: the one at hand, as long as the sample is in it.
    #[inline]
    fn go_on<'a>(
        at_hand: &'a mut Option<Self>,
        sampler: &SobolSampler,
        id: SampleId,
        dimension: u32,
    ) -> &'a Self {
        let first = SampleId { index: id.index & !(BLOCK - 1), ..id };
        if at_hand.as_ref().is_none_or(|block| block.first != first) {
            *at_hand = Some(Self::new(sampler, id, dimension));
        }
        at_hand.as_ref().expect("there is one by now")
    }

    /// Both coordinates of a sample of the block before they are scrambled, with bits in reverse.
    #[inline]
    fn place(&self, index: u32) -> [u32; 2] {
        let within = shuffle_within_block(index, self.coins);
        let [x, y] = FIRST_PAIRS[self.half as usize][within];
        [self.base[0] ^ x, self.base[1] ^ y]
    }
}

/// How many points are scrambled together.
const LANES: usize = 16;

/// Points on their way through the scramble.
#[derive(Default)]
struct Lanes {
    x: [u64; LANES],
    y: [u64; LANES],
    x_seeds: [u64; LANES],
    y_seeds: [u64; LANES],
}

impl Lanes {
    #[inline]
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
