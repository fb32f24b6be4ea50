//! [`Part`]: which of a render's samples are taken.

use std::num::NonZeroU32;
use std::ops::Range;

/// One of several parts into which the samples of each pixel are divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Which one, from 0.
    pub index: u32,
    /// How many there are.
    pub count: NonZeroU32,
}

impl Part {
    /// Its samples, of `spp` in a pixel: parts differ by at most one sample, and together take each sample once. Empty if
    /// there are more parts than samples, or no such part.
    pub fn samples(self, spp: u32) -> Range<u32> {
        let (index, count) = (u64::from(self.index), u64::from(self.count.get()));
        // At most `spp`, which is a u32.
        let below = |parts: u64| (u64::from(spp) * parts.min(count) / count) as u32;
        below(index)..below(index + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_take_each_sample_once() {
        for (spp, count) in [(64, 1), (64, 2), (64, 5), (61, 8), (3, 5), (u32::MAX, 1000)] {
            let mut end = 0;
            for index in 0..count {
                let count = NonZeroU32::new(count).unwrap();
                let samples = Part { index, count }.samples(spp);
                assert_eq!(samples.start, end, "{spp} samples in {count} parts");
                assert!(samples.len().abs_diff(spp as usize / count.get() as usize) <= 1);
                end = samples.end;
            }
            assert_eq!(end, spp);
        }
    }
}
