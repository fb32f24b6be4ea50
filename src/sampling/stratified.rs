//! [`StratifiedSampler`]: one jittered sample per cell of a grid.

use glam::Vec2;

use super::hash::{hash, hash_in_set, hash_set, mix, unit_float};
use super::permutation::Permutation;
use super::wide::{IdBlock, Lanes, Seeds, WIDTH, WideSampler};
use super::{Make, SampleId, Sampler, SamplerKind};
use crate::geometry::float::ONE_MINUS_EPSILON;
use crate::params::Kind;
use crate::simd::InstructionSet;

/// Stratified (jittered) sampling: the unit square is cut into equal cells, and each sample of a
/// set has its own cell (PBRT 3rd edition, section 7.3). Each pixel, set and dimension has its own
/// random assignment of samples to cells, so dimensions are independent.
///
/// Sets may have any number of samples. If that is not the product of two close factors, the grid
/// has a few cells more, and which of them stay empty is random: the estimate is unbiased. Samples
/// beyond the set begin a new one.
#[derive(Clone, Copy, Debug)]
pub struct StratifiedSampler {
    samples_per_set: u32,
    columns: u32,
    rows: u32,
    /// Seed of the jitter, which is drawn for each sample.
    jitter_seed: u64,
    /// Seed of the assignment of cells, which is drawn for each set.
    order_seed: u64,
    instruction_set: InstructionSet,
}

impl StratifiedSampler {
    /// A sampler for sets of `samples_per_set` samples, at least 1. Different seeds give different
    /// images.
    pub fn new(samples_per_set: u32, seed: u64) -> Self {
        let samples_per_set = samples_per_set.max(1);
        // With at most columns² + 2 columns samples there are no more cells: they fit into 32 bits, as samples do.
        let columns = samples_per_set.isqrt();
        let rows = samples_per_set.div_ceil(columns);
        let (jitter_seed, order_seed) = (mix(seed), mix(!seed));
        let instruction_set = InstructionSet::fastest();
        Self { samples_per_set, columns, rows, jitter_seed, order_seed, instruction_set }
    }

    /// Other instructions than the fastest, for measuring and tests.
    pub fn with_instruction_set(self, instruction_set: InstructionSet) -> Self {
        Self { instruction_set, ..self }
    }

    /// The coordinates of a sample.
    #[inline(always)]
    fn get<const D: usize>(&self, id: SampleId, dimension: u32) -> [f32; D] {
        let set = SampleId { index: id.index / self.samples_per_set, ..id };
        let key = hash(self.order_seed, set, dimension);
        let cell = self.permutation::<D>().get(id.index % self.samples_per_set, key);
        self.place(cell, hash(self.jitter_seed, id, dimension))
    }

    /// The assignment of cells.
    #[inline(always)]
    fn permutation<const D: usize>(&self) -> Permutation {
        Permutation::new(if D == 1 { self.samples_per_set } else { self.columns * self.rows })
    }

    /// The coordinates of a sample in `cell` with these random bits.
    #[inline(always)]
    fn place<const D: usize>(&self, cell: u32, bits: u64) -> [f32; D] {
        let jitters = [unit_float((bits >> 32) as u32), unit_float(bits as u32)];
        let (cells, counts) = if D == 1 {
            ([cell, 0], [self.samples_per_set, 1])
        } else {
            (self.column_and_row(cell), [self.columns, self.rows])
        };
        let mut place = [0.0; D];
        for (d, x) in place.iter_mut().enumerate() {
            *x = within(cells[d], jitters[d], counts[d]);
        }
        place
    }

    /// Remainder and quotient of `cell` by the number of columns, without a division, which vectors lack.
    #[inline(always)]
    fn column_and_row(&self, cell: u32) -> [u32; 2] {
        let columns = self.columns;
        // The quotient, or one less.
        let row = ((u64::from(cell) * u64::from(u32::MAX / columns)) >> 32) as u32;
        let column = cell - row * columns;
        if column < columns { [column, row] } else { [column - columns, row + 1] }
    }
}

impl Sampler for StratifiedSampler {
    fn is_correlated(&self) -> bool {
        KIND.read.is_correlated
    }

    #[inline]
    fn get_1d(&self, id: SampleId, dimension: u32) -> f32 {
        let [x] = self.get(id, dimension);
        x
    }

    #[inline]
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2 {
        self.get(id, dimension).into()
    }

    fn fill_1d(&self, ids: &[SampleId], dimension: u32, values: &mut [f32]) {
        self.fill_values(ids, dimension, values);
    }

    fn fill_2d(&self, ids: &[SampleId], dimension: u32, points: &mut [Vec2]) {
        self.fill_points(ids, dimension, points);
    }
}

impl Seeds for StratifiedSampler {
    /// Those of the assignment of cells, for samples that do not begin a new set, and of the jitter.
    #[inline(always)]
    fn seeds(&self, id: SampleId, dimension: u32) -> [u64; 2] {
        let set = SampleId { index: 0, ..id };
        [hash(self.order_seed, set, dimension), hash_set(self.jitter_seed, id)]
    }
}

impl WideSampler for StratifiedSampler {
    fn instruction_set(&self) -> InstructionSet {
        self.instruction_set
    }

    #[inline(always)]
    fn block<const D: usize>(&self, ids: &IdBlock, dimension: u32) -> [Lanes<f32>; D] {
        let mut rows = [[0.0; WIDTH]; D];
        if ids.index.iter().any(|&index| index >= self.samples_per_set) {
            for i in 0..WIDTH {
                for (row, x) in rows.iter_mut().zip(self.get::<D>(ids.id(i), dimension)) {
                    row[i] = x;
                }
            }
            return rows;
        }
        let [keys, jitters] = ids.seeds(self, dimension);
        let cells = self.permutation::<D>().get_all(&ids.index, &keys);
        for i in 0..WIDTH {
            let bits = hash_in_set(jitters[i], ids.index[i], dimension);
            for (row, x) in rows.iter_mut().zip(self.place::<D>(cells[i], bits)) {
                row[i] = x;
            }
        }
        rows
    }
}

/// The position `jitter` of the way through `cell`, where `cells` of them fill `[0, 1)`. Rounding
/// never gives 1.
#[inline(always)]
fn within(cell: u32, jitter: f32, cells: u32) -> f32 {
    ((cell as f32 + jitter) / cells as f32).min(ONE_MINUS_EPSILON)
}

impl SamplerKind {
    /// [`StratifiedSampler`].
    pub const STRATIFIED: Self = Self(&KIND);
}

/// `type = "stratified"`
pub(super) const KIND: Kind<Make> = Kind {
    name: "stratified",
    meaning: "One jittered sample in each cell of a grid",
    keys: &[],
    read: Make {
        is_correlated: true,
        make: |sets| Box::new(StratifiedSampler::new(sets.samples_per_set, sets.seed)),
    },
};

#[cfg(test)]
mod tests {
    use super::*;

    /// Seen to fail with one column more.
    #[test]
    fn cells_of_any_number_of_samples_fit_into_32_bits() {
        let ends = [1, 2, 3, 4, u32::MAX].into_iter();
        let squares = [2_u32, 3, 1000, 65_534, 65_535].into_iter();
        let around =
            squares.flat_map(|n| [n * n - 1, n * n, n * n + 1, n * (n + 1), n * (n + 1) + 1]);
        for samples in ends.chain(around) {
            let StratifiedSampler { columns, rows, .. } = StratifiedSampler::new(samples, 0);
            let cells = u64::from(columns) * u64::from(rows);
            assert!((u64::from(samples)..=u32::MAX.into()).contains(&cells), "{samples}: {cells}");
        }
    }

    /// Seen to fail with a quotient that is not corrected.
    #[test]
    fn columns_and_rows_are_remainders_and_quotients() {
        for samples in [1, 2, 3, 64, 100, 1000, 65_536, 1 << 31, u32::MAX] {
            let sampler = StratifiedSampler::new(samples, 0);
            let StratifiedSampler { columns, rows, .. } = sampler;
            let cells = columns * rows;
            let borders = (0..rows.min(2000)).flat_map(|row| [row, rows - 1 - row]);
            let around = borders.flat_map(|row| [row * columns, row * columns + columns - 1]);
            for cell in around.chain([cells - 1]) {
                let expected = [cell % columns, cell / columns];
                assert_eq!(sampler.column_and_row(cell), expected, "{cell} of {samples}");
            }
        }
    }
}
