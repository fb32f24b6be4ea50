//! [`SamplerKind`]: samplers by name.

use std::fmt::{self, Debug, Formatter};

use glam::UVec2;

use super::sampler::Sampler;
use crate::params::Kind;

/// What a sampler is made for.
#[derive(Clone, Copy, Debug)]
pub struct SampleSets {
    /// Columns and rows of the whole image.
    pub resolution: UVec2,
    /// Samples in each set of a pixel, at least 1.
    pub samples_per_set: u32,
    /// Each seed gives other samples.
    pub seed: u64,
}

/// How a kind of sampler is made.
#[derive(Clone, Copy, Debug)]
pub struct Make {
    /// [`Sampler::is_correlated`] of all samplers of this kind.
    pub is_correlated: bool,
    /// Makes one.
    pub make: fn(&SampleSets) -> Box<dyn Sampler>,
}

/// A kind of sampler: one of [`SAMPLERS`](super::SAMPLERS).
#[derive(Clone, Copy)]
pub struct SamplerKind(pub(crate) &'static Kind<Make>);

impl SamplerKind {
    /// Its name in scene files.
    pub const fn name(self) -> &'static str {
        self.0.name
    }

    /// Whether samples of a set are correlated: [`Sampler::is_correlated`].
    pub const fn is_correlated(self) -> bool {
        self.0.read.is_correlated
    }

    /// A sampler of this kind.
    pub fn make(self, sets: &SampleSets) -> Box<dyn Sampler> {
        (self.0.read.make)(sets)
    }
}

/// By name.
impl PartialEq for SamplerKind {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Eq for SamplerKind {}

impl Debug for SamplerKind {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(self.name())
    }
}
