//! [`StratifiedSampler`]: one jittered sample per cell of a grid.

use glam::Vec2;

use super::hash::{hash, mix, permute, unit_float};
use super::{Make, SampleId, Sampler, SamplerKind};
use crate::geometry::float::ONE_MINUS_EPSILON;
use crate::params::Kind;

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
        Self { samples_per_set, columns, rows, jitter_seed, order_seed }
    }

    /// The key of the permutation that a set has in `dimension`, and the sample's index within the
    /// set.
    #[inline]
    fn shared(&self, id: SampleId, dimension: u32) -> (u64, u32) {
        let set = SampleId { index: id.index / self.samples_per_set, ..id };
        (hash(self.order_seed, set, dimension), id.index % self.samples_per_set)
    }
}

impl Sampler for StratifiedSampler {
    fn is_correlated(&self) -> bool {
        KIND.read.is_correlated
    }

    #[inline]
    fn get_1d(&self, id: SampleId, dimension: u32) -> f32 {
        let (key, index) = self.shared(id, dimension);
        let cell = permute(index, self.samples_per_set, key);
        let jitter = unit_float((hash(self.jitter_seed, id, dimension) >> 32) as u32);
        within(cell, jitter, self.samples_per_set)
    }

    #[inline]
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2 {
        let (key, index) = self.shared(id, dimension);
        let cell = permute(index, self.columns * self.rows, key);
        let bits = hash(self.jitter_seed, id, dimension);
        Vec2::new(
            within(cell % self.columns, unit_float((bits >> 32) as u32), self.columns),
            within(cell / self.columns, unit_float(bits as u32), self.rows),
        )
    }
}

/// The position `jitter` of the way through `cell`, where `cells` of them fill `[0, 1)`. Rounding
/// never gives 1.
#[inline]
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
}
