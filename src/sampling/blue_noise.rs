//! [`BlueNoiseSampler`]: error that differs from pixel to pixel as blue noise.

use glam::{UVec2, Vec2};

use super::hash::{hash, mix};
use super::sobol::couple;
use super::{Make, SampleId, Sampler, SamplerKind, SobolSampler};
use crate::params::Kind;

/// Sobol points dealt out over the whole image, so that what one pixel has too much of its neighbours lack: the
/// error looks finer than that of other samplers and vanishes when the image is seen from afar.
///
/// Samples of one pixel know of each other, and so do pixels: errors of neighbours are not independent. An error
/// that is told from sets of samples ([`SampleId::set`]) stays right for each pixel, but a sum over pixels varies
/// less than their errors say.
///
/// Sets have a power of two of samples; samples beyond begin another, independent one. Pixels share one sequence as
/// long as it is not longer than 2³² samples. Larger images are cut into squares that know nothing of each other,
/// which takes 65,536 pixels in a row with one sample per pixel, and 2048 with 1024.
///
/// Ahmed and Wonka 2020, "[Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering
/// of Pixels](https://doi.org/10.1145/3414685.3417881)", section 4: pixels stand in Morton order, and in each couple
/// of dimensions the quarters of each square are dealt out in another order. Dimensions are as in [`SobolSampler`].
#[derive(Clone, Copy, Debug)]
pub struct BlueNoiseSampler {
    sobol: SobolSampler,
    order_seed: u64,
    /// Binary logarithm of the samples in a set.
    set_bits: u32,
    /// Binary logarithm of the side of the square of pixels that share a sequence.
    side_bits: u32,
}

impl BlueNoiseSampler {
    /// A sampler for images of this many columns and rows and for sets of `samples_per_set` samples, at least 1,
    /// rounded up to a power of two, at most 2³¹; each seed gives another image.
    pub fn new(resolution: UVec2, samples_per_set: u32, seed: u64) -> Self {
        let bits = |n: u32| n.max(1).saturating_sub(1).checked_ilog2().map_or(0, |log| log + 1);
        let set_bits = bits(samples_per_set).min(31);
        let side_bits = bits(resolution.max_element()).min((32 - set_bits) / 2);
        let order_seed = mix(seed.rotate_left(32));
        Self { sobol: SobolSampler::new(seed), order_seed, set_bits, side_bits }
    }

    /// The name of a square and set of samples, as if it were one pixel's, with index 0.
    #[inline]
    fn square(&self, id: SampleId) -> SampleId {
        let pixel = UVec2::new(id.pixel.x >> self.side_bits, id.pixel.y >> self.side_bits);
        let set = match id.index >> self.set_bits {
            0 => id.set,
            later => mix(u64::from(later) << 32 | u64::from(id.set)) as u32,
        };
        SampleId { pixel, set, index: 0 }
    }

    /// The square's sample that belongs to the first of the pixel's.
    #[inline]
    fn first_index(&self, id: SampleId, square: SampleId, dimension: u32) -> u32 {
        let order = hash(self.order_seed, square, couple(dimension).0);
        let (mut above, mut index) = (1_u64, 0_u32);
        for bit in (0..self.side_bits).rev() {
            let quarter = (id.pixel.x >> bit & 1) | (id.pixel.y >> bit & 1) << 1;
            index =
                index << 2 | ORDERS[(mix(order ^ above) >> 32) as usize % 24] >> (2 * quarter) & 3;
            above = above << 2 | u64::from(quarter);
        }
        index << self.set_bits
    }

    /// The sample of the sequence that stands for this one.
    #[inline]
    fn place(&self, id: SampleId, dimension: u32) -> SampleId {
        let square = self.square(id);
        SampleId { index: self.first_index(id, square, dimension) | self.within(id), ..square }
    }

    /// The sample's place in its set.
    #[inline]
    fn within(&self, id: SampleId) -> u32 {
        id.index & ((1 << self.set_bits) - 1)
    }

    /// The samples of the sequence that stand for these; the pixel's part is found once as long as it stays.
    #[inline]
    fn places(&self, ids: &[SampleId], dimension: u32) -> impl ExactSizeIterator<Item = SampleId> {
        let mut at_hand: Option<(SampleId, SampleId)> = None;
        ids.iter().map(move |&id| {
            let first = SampleId { index: id.index >> self.set_bits << self.set_bits, ..id };
            let place = match at_hand {
                Some((of, place)) if of == first => place,
                _ => self.place(first, dimension),
            };
            at_hand = Some((first, place));
            SampleId { index: place.index | self.within(id), ..place }
        })
    }
}

impl Sampler for BlueNoiseSampler {
    fn is_correlated(&self) -> bool {
        KIND.read.is_correlated
    }

    #[inline]
    fn get_1d(&self, id: SampleId, dimension: u32) -> f32 {
        self.sobol.get_1d(self.place(id, dimension), dimension)
    }

    #[inline]
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2 {
        self.sobol.get_2d(self.place(id, dimension), dimension)
    }

    fn fill_1d(&self, ids: &[SampleId], dimension: u32, values: &mut Vec<f32>) {
        self.sobol.fill_1d_of(self.places(ids, dimension), dimension, values);
    }

    fn fill_2d(&self, ids: &[SampleId], dimension: u32, points: &mut Vec<Vec2>) {
        self.sobol.fill_2d_of(self.places(ids, dimension), dimension, points);
    }
}

/// All orders of four things, two bits for each.
const ORDERS: [u32; 24] = {
    let mut orders = [0; 24];
    let (mut count, mut order) = (0, 0);
    while order < 256 {
        let seen =
            1 << (order & 3) | 1 << (order >> 2 & 3) | 1 << (order >> 4 & 3) | 1 << (order >> 6);
        if seen == 0b1111 {
            orders[count] = order;
            count += 1;
        }
        order += 1;
    }
    orders
};

impl SamplerKind {
    /// [`BlueNoiseSampler`].
    pub const BLUE_NOISE: Self = Self(&KIND);
}

/// `type = "blue-noise"`
pub(super) const KIND: Kind<Make> = Kind {
    name: "blue-noise",
    meaning: "Sobol points whose error is blue noise over the image",
    keys: &[],
    read: Make {
        is_correlated: true,
        make: |sets| {
            Box::new(BlueNoiseSampler::new(sets.resolution, sets.samples_per_set, sets.seed))
        },
    },
};
