//! [`Random`]: a stream of random numbers, for estimates that need no sampler.

use super::hash::mix;

/// A stream of independent uniform numbers.
pub struct Random {
    state: u64,
}

impl Random {
    /// The stream of a seed.
    pub fn new(seed: u64) -> Self {
        Self { state: mix(seed) }
    }

    /// The next number, in `[0, 1)`.
    #[inline]
    pub fn next(&mut self) -> f32 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        (mix(self.state) >> 40) as f32 * (1.0 / (1 << 24) as f32)
    }
}
