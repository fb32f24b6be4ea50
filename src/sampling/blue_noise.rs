//! [`BlueNoiseSampler`]: Sobol points whose error is blue noise in screen space.

use glam::{UVec2, Vec2};

use super::hash::{hash, mix};
use super::sobol::couple;
use super::wide::{IdBlock, Lanes, WIDTH, WideSampler};
use super::{Make, SampleId, Sampler, SamplerKind, SobolSampler};
use crate::params::Kind;
use crate::simd::InstructionSet;

/// Sobol points distributed over the whole image, so that the errors of neighbouring pixels tend to
/// cancel: error is blue noise in screen space. It looks finer than that of other samplers, and
/// disappears when the image is seen from a distance.
///
/// Samples are correlated within a set, and between pixels too. A variance estimated from sets of
/// samples ([`SampleId::set`]) is right for each pixel, but the error of a sum over pixels is
/// smaller than the pixels' variances suggest.
///
/// A set has a power of two of samples; further samples begin another, independent set. Pixels
/// share one sequence of at most 2³² samples. A larger image is cut into independent squares, whose
/// side is 65,536 pixels at one sample per pixel, and 2048 at 1024.
///
/// Ahmed and Wonka 2020, "[Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via
/// Hierarchical Ordering of Pixels](https://doi.org/10.1145/3414685.3417881)", section 4: pixels
/// take consecutive stretches of the sequence in Morton order. At each level of that order the four
/// quadrants are permuted at random, differently for each couple of dimensions. Dimensions are
/// those of [`SobolSampler`].
#[derive(Clone, Copy, Debug)]
pub struct BlueNoiseSampler {
    sobol: SobolSampler,
    order_seed: u64,
    /// Binary logarithm of the number of samples in a set.
    set_bits: u32,
    /// Binary logarithm of the side, in pixels, of the square that shares a sequence.
    side_bits: u32,
}

impl BlueNoiseSampler {
    /// A sampler for images of `resolution` columns and rows and sets of `samples_per_set` samples:
    /// at least 1, rounded up to a power of two, at most 2³¹. Different seeds give different
    /// images.
    pub fn new(resolution: UVec2, samples_per_set: u32, seed: u64) -> Self {
        let bits = |n: u32| n.max(1).saturating_sub(1).checked_ilog2().map_or(0, |log| log + 1);
        let set_bits = bits(samples_per_set).min(31);
        let side_bits = bits(resolution.max_element()).min((32 - set_bits) / 2);
        let order_seed = mix(seed.rotate_left(32));
        Self { sobol: SobolSampler::new(seed), order_seed, set_bits, side_bits }
    }

    /// Other instructions than the fastest, for measuring and tests.
    pub fn with_instruction_set(self, instruction_set: InstructionSet) -> Self {
        Self { sobol: self.sobol.with_instruction_set(instruction_set), ..self }
    }

    /// The key of the square and set that `id` belongs to: the id that [`SobolSampler`] would be
    /// given for a pixel, with index 0.
    #[inline]
    fn square(&self, id: SampleId) -> SampleId {
        let pixel = UVec2::new(id.pixel.x >> self.side_bits, id.pixel.y >> self.side_bits);
        let set = match id.index >> self.set_bits {
            0 => id.set,
            later => mix(u64::from(later) << 32 | u64::from(id.set)) as u32,
        };
        SampleId { pixel, set, index: 0 }
    }

    /// The index in the square's sequence of the first sample of `id`'s pixel: its Morton code,
    /// with the quadrants of each level permuted.
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

    /// The id under which the sample is found in the square's sequence.
    #[inline]
    fn in_sequence(&self, id: SampleId, dimension: u32) -> SampleId {
        let square = self.square(id);
        SampleId {
            index: self.first_index(id, square, dimension) | self.index_in_set(id.index),
            ..square
        }
    }

    /// The index within its set of the sample with this index.
    #[inline(always)]
    fn index_in_set(&self, index: u32) -> u32 {
        index & ((1 << self.set_bits) - 1)
    }

    /// The first sample of the set of `id`.
    #[inline(always)]
    fn first_of_set(&self, id: SampleId) -> SampleId {
        SampleId { index: id.index - self.index_in_set(id.index), ..id }
    }
}

impl Sampler for BlueNoiseSampler {
    fn is_correlated(&self) -> bool {
        KIND.read.is_correlated
    }

    #[inline]
    fn get_1d(&self, id: SampleId, dimension: u32) -> f32 {
        self.sobol.get_1d(self.in_sequence(id, dimension), dimension)
    }

    #[inline]
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2 {
        self.sobol.get_2d(self.in_sequence(id, dimension), dimension)
    }

    fn fill_1d(&self, ids: &[SampleId], dimension: u32, values: &mut [f32]) {
        self.fill_values(ids, dimension, values);
    }

    fn fill_2d(&self, ids: &[SampleId], dimension: u32, points: &mut [Vec2]) {
        self.fill_points(ids, dimension, points);
    }
}

impl WideSampler for BlueNoiseSampler {
    fn instruction_set(&self) -> InstructionSet {
        self.sobol.instruction_set()
    }

    /// Finds the place in the sequence once for a run of samples.
    #[inline(always)]
    fn block<const D: usize>(&self, ids: &IdBlock, dimension: u32) -> [Lanes<f32>; D] {
        let mut first = self.first_of_set(ids.id(0));
        let mut place = self.in_sequence(first, dimension);
        let (mut indices, mut differ) = ([0; WIDTH], 0);
        for (there, index) in indices.iter_mut().zip(ids.index) {
            *there = place.index | self.index_in_set(index);
            differ |= (index ^ first.index) >> self.set_bits;
        }
        let there = if ids.starts == 1 && differ == 0 {
            IdBlock::of_set(place, indices)
        } else {
            let mut there = [place; WIDTH];
            for (i, there) in there.iter_mut().enumerate() {
                let id = ids.id(i);
                if self.first_of_set(id) != first {
                    first = self.first_of_set(id);
                    place = self.in_sequence(first, dimension);
                }
                *there = SampleId { index: place.index | self.index_in_set(id.index), ..place };
            }
            IdBlock::new(&there)
        };
        self.sobol.block(&there, dimension)
    }
}

/// All permutations of four elements, two bits for each.
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
