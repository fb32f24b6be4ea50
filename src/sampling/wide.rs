//! [`WideSampler`]: samplers that compute the values of several samples at a time.

use glam::{UVec2, Vec2};

use super::SampleId;
use crate::simd::{Block, BlockKernel, InstructionSet, ROW, RowMask, indices};

/// Number of samples in a block.
pub const WIDTH: usize = ROW;

/// A number for each sample of a block.
pub type Lanes<T> = [T; WIDTH];

/// A sampler that computes the values of a block of samples together.
///
/// It does so in loops of [`WIDTH`] rounds, which the compiler vectorises for each instruction set. All they call is marked
/// `#[inline(always)]`, as in a [`BlockKernel`]. A loop is fastest if all its integers have the same size.
pub trait WideSampler {
    /// The instructions to use.
    fn instruction_set(&self) -> InstructionSet;

    /// The value of each sample for `D` = 1, both coordinates of its point for 2.
    fn block<const D: usize>(&self, ids: &IdBlock, dimension: u32) -> [Lanes<f32>; D];

    /// [`Sampler::fill_1d`](super::Sampler::fill_1d).
    #[inline]
    fn fill_values(&self, ids: &[SampleId], dimension: u32, values: &mut [f32]) {
        let values = bytemuck::cast_slice_mut::<_, [f32; 1]>(values);
        self.instruction_set().run_block(Fill { sampler: self, ids, dimension, values });
    }

    /// [`Sampler::fill_2d`](super::Sampler::fill_2d).
    #[inline]
    fn fill_points(&self, ids: &[SampleId], dimension: u32, points: &mut [Vec2]) {
        let values = bytemuck::cast_slice_mut::<_, [f32; 2]>(points);
        self.instruction_set().run_block(Fill { sampler: self, ids, dimension, values });
    }
}

/// Fills `values` block by block.
struct Fill<'a, S: ?Sized, const D: usize> {
    sampler: &'a S,
    ids: &'a [SampleId],
    dimension: u32,
    values: &'a mut [[f32; D]],
}

impl<S: WideSampler + ?Sized, const D: usize> BlockKernel for Fill<'_, S, D> {
    type Output = ();

    #[inline(always)]
    fn run<F: Block>(self) {
        assert_eq!(self.ids.len(), self.values.len(), "a value for each sample");
        for (ids, values) in self.ids.chunks(WIDTH).zip(self.values.chunks_mut(WIDTH)) {
            let mut padded;
            let ids = match ids.first_chunk() {
                Some(ids) => ids,
                None => {
                    padded = [ids[0]; WIDTH];
                    padded[..ids.len()].copy_from_slice(ids);
                    &padded
                }
            };
            let rows = self.sampler.block::<D>(&IdBlock::new(ids), self.dimension);
            for (i, value) in values.iter_mut().enumerate() {
                for (x, row) in value.iter_mut().zip(&rows) {
                    *x = row[i % WIDTH];
                }
            }
        }
    }
}

/// The ids of a block of samples.
pub struct IdBlock {
    x: Lanes<u32>,
    y: Lanes<u32>,
    set: Lanes<u32>,
    /// Indices within sets.
    pub index: Lanes<u32>,
    /// Which samples begin a run: those behind them, up to the next one, are in the same set of the same pixel.
    pub starts: RowMask,
}

impl IdBlock {
    /// A block of these samples.
    #[inline(always)]
    pub fn new(ids: &Lanes<SampleId>) -> Self {
        let zero = [0; WIDTH];
        let mut block = Self { x: zero, y: zero, set: zero, index: zero, starts: 1 };
        for (i, &SampleId { pixel, set, index }) in ids.iter().enumerate() {
            (block.x[i], block.y[i], block.set[i], block.index[i]) = (pixel.x, pixel.y, set, index);
        }
        let mut differ = 0;
        for i in 0..WIDTH {
            differ |= block.differs(i, 0);
        }
        if differ != 0 {
            for i in 1..WIDTH {
                block.starts |= RowMask::from(block.differs(i, i - 1) != 0) << i;
            }
        }
        block
    }

    /// The samples of one set that have these indices.
    #[inline(always)]
    pub fn of_set(set: SampleId, index: Lanes<u32>) -> Self {
        let SampleId { pixel, set, .. } = set;
        let [x, y, set] = [[pixel.x; WIDTH], [pixel.y; WIDTH], [set; WIDTH]];
        Self { x, y, set, index, starts: 1 }
    }

    /// 0 if two samples are in the same set of the same pixel.
    #[inline(always)]
    fn differs(&self, i: usize, j: usize) -> u32 {
        (self.x[i] ^ self.x[j]) | (self.y[i] ^ self.y[j]) | (self.set[i] ^ self.set[j])
    }

    /// The id of a sample.
    #[inline(always)]
    pub fn id(&self, i: usize) -> SampleId {
        let pixel = UVec2::new(self.x[i], self.y[i]);
        SampleId { pixel, set: self.set[i], index: self.index[i] }
    }

    /// The seeds of each sample's set.
    #[inline(always)]
    pub fn seeds(&self, of: &impl Seeds, dimension: u32) -> [Lanes<u64>; 2] {
        let mut seeds = [[0; WIDTH]; 2];
        if self.starts.count_ones() > MOST_RUNS {
            let [a, b] = &mut seeds;
            for (i, (a, b)) in a.iter_mut().zip(b).enumerate() {
                [*a, *b] = of.seeds(self.id(i), dimension);
            }
        } else {
            for start in indices(self.starts) {
                for (seeds, seed) in seeds.iter_mut().zip(of.seeds(self.id(start), dimension)) {
                    seeds[start..].fill(seed);
                }
            }
        }
        seeds
    }
}

/// Most runs for which seeds one after the other are faster than those of all samples at once.
const MOST_RUNS: u32 = 16;

/// What the samples of a set have in common.
pub trait Seeds {
    /// Two words for the set of `id`, whatever its index. Always inlined.
    fn seeds(&self, id: SampleId, dimension: u32) -> [u64; 2];
}
