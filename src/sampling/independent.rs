//! [`IndependentSampler`]: uniform random numbers.

use glam::Vec2;

use super::hash::{hash, mix, unit_float};
use super::{SampleId, Sampler};

/// Uniform random numbers that know nothing of each other. Error falls with 1/√n.
#[derive(Clone, Copy, Debug)]
pub struct IndependentSampler {
    mixed_seed: u64,
}

impl IndependentSampler {
    /// Each seed gives another image.
    pub fn new(seed: u64) -> Self {
        Self { mixed_seed: mix(seed) }
    }
}

impl Sampler for IndependentSampler {
    fn is_correlated(&self) -> bool {
        false
    }

    #[inline]
    fn get_1d(&self, id: SampleId, dimension: u32) -> f32 {
        unit_float((hash(self.mixed_seed, id, dimension) >> 32) as u32)
    }

    #[inline]
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2 {
        let bits = hash(self.mixed_seed, id, dimension);
        Vec2::new(unit_float((bits >> 32) as u32), unit_float(bits as u32))
    }
}
