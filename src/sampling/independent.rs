//! [`IndependentSampler`]: independent uniform random numbers.

use glam::Vec2;

use super::hash::{hash, hash_in_set, hash_set, mix, unit_float};
use super::wide::{IdBlock, Lanes, Seeds, WIDTH, WideSampler};
use super::{Make, SampleId, Sampler, SamplerKind};
use crate::params::Kind;
use crate::simd::InstructionSet;

/// Independent uniform random numbers. The standard error of n samples falls as 1/√n.
#[derive(Clone, Copy, Debug)]
pub struct IndependentSampler {
    mixed_seed: u64,
    instruction_set: InstructionSet,
}

impl IndependentSampler {
    /// Different seeds give different images.
    pub fn new(seed: u64) -> Self {
        Self { mixed_seed: mix(seed), instruction_set: InstructionSet::fastest() }
    }

    /// Other instructions than the fastest, for measuring and tests.
    pub fn with_instruction_set(self, instruction_set: InstructionSet) -> Self {
        Self { instruction_set, ..self }
    }
}

impl Sampler for IndependentSampler {
    fn is_correlated(&self) -> bool {
        KIND.read.is_correlated
    }

    #[inline]
    fn get_1d(&self, id: SampleId, dimension: u32) -> f32 {
        let [x, _] = point(hash(self.mixed_seed, id, dimension));
        x
    }

    #[inline]
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2 {
        point(hash(self.mixed_seed, id, dimension)).into()
    }

    fn fill_1d(&self, ids: &[SampleId], dimension: u32, values: &mut [f32]) {
        self.fill_values(ids, dimension, values);
    }

    fn fill_2d(&self, ids: &[SampleId], dimension: u32, points: &mut [Vec2]) {
        self.fill_points(ids, dimension, points);
    }
}

impl Seeds for IndependentSampler {
    #[inline(always)]
    fn seeds(&self, id: SampleId, _dimension: u32) -> [u64; 2] {
        [hash_set(self.mixed_seed, id), 0]
    }
}

impl WideSampler for IndependentSampler {
    fn instruction_set(&self) -> InstructionSet {
        self.instruction_set
    }

    #[inline(always)]
    fn block<const D: usize>(&self, ids: &IdBlock, dimension: u32) -> [Lanes<f32>; D] {
        let [sets, _] = ids.seeds(self, dimension);
        let mut rows = [[0.0; WIDTH]; D];
        for i in 0..WIDTH {
            let p = point(hash_in_set(sets[i], ids.index[i], dimension));
            for (row, x) in rows.iter_mut().zip(p) {
                row[i] = x;
            }
        }
        rows
    }
}

#[inline(always)]
fn point(bits: u64) -> [f32; 2] {
    [unit_float((bits >> 32) as u32), unit_float(bits as u32)]
}

impl SamplerKind {
    /// [`IndependentSampler`].
    pub const INDEPENDENT: Self = Self(&KIND);
}

/// `type = "independent"`
pub(super) const KIND: Kind<Make> = Kind {
    name: "independent",
    meaning: "Uniform random numbers",
    keys: &[],
    read: Make { is_correlated: false, make: |sets| Box::new(IndependentSampler::new(sets.seed)) },
};
