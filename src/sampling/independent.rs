//! [`IndependentSampler`]: independent uniform random numbers.

use glam::Vec2;

use super::hash::{hash, hash_in_set, hash_set, mix, unit_float};
use super::{Make, SampleId, Sampler, SamplerKind};
use crate::params::Kind;

/// Independent uniform random numbers. The standard error of n samples falls as 1/√n.
#[derive(Clone, Copy, Debug)]
pub struct IndependentSampler {
    mixed_seed: u64,
}

impl IndependentSampler {
    /// Different seeds give different images.
    pub fn new(seed: u64) -> Self {
        Self { mixed_seed: mix(seed) }
    }

    /// Calls `each` for each run of samples in the same set, with the set's part of the hash.
    #[inline]
    fn for_sets(&self, ids: &[SampleId], mut each: impl FnMut(u64, &[SampleId])) {
        for of_set in SampleId::sets(ids) {
            each(hash_set(self.mixed_seed, of_set[0]), of_set);
        }
    }
}

impl Sampler for IndependentSampler {
    fn is_correlated(&self) -> bool {
        KIND.read.is_correlated
    }

    #[inline]
    fn get_1d(&self, id: SampleId, dimension: u32) -> f32 {
        value(hash(self.mixed_seed, id, dimension))
    }

    #[inline]
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2 {
        point(hash(self.mixed_seed, id, dimension))
    }

    fn fill_1d(&self, ids: &[SampleId], dimension: u32, values: &mut Vec<f32>) {
        values.clear();
        self.for_sets(ids, |set, of_set| {
            values.extend(of_set.iter().map(|id| value(hash_in_set(set, id.index, dimension))));
        });
    }

    fn fill_2d(&self, ids: &[SampleId], dimension: u32, points: &mut Vec<Vec2>) {
        points.clear();
        self.for_sets(ids, |set, of_set| {
            points.extend(of_set.iter().map(|id| point(hash_in_set(set, id.index, dimension))));
        });
    }
}

#[inline]
fn value(bits: u64) -> f32 {
    unit_float((bits >> 32) as u32)
}

#[inline]
fn point(bits: u64) -> Vec2 {
    Vec2::new(unit_float((bits >> 32) as u32), unit_float(bits as u32))
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
