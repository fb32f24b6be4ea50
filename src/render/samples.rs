//! [`Samples`]: all samples of a pass over a tile.

use std::ops::Range;

use glam::UVec2;

use crate::image::Window;
use crate::sampling::SampleId;

/// The samples of a pass: pixel by pixel, row by row, in each pixel set by set, in each set by index.
pub struct Samples {
    window: Window,
    sets: u32,
    pass: Range<u32>,
    next: SampleId,
}

impl Samples {
    /// The samples whose indices are in `pass`, which is not empty, of `sets` sets for each pixel of `window`.
    pub fn new(window: Window, sets: u32, pass: Range<u32>) -> Self {
        let next = SampleId { pixel: window.min, set: 0, index: pass.start };
        Self { window, sets, pass, next }
    }

    /// Whether all have been handed out.
    pub fn is_empty(&self) -> bool {
        self.next.pixel.y >= self.window.max.y
    }

    /// Hands out the next `most`, or as many as there are, in place of what `ids` holds.
    pub fn fill(&mut self, most: usize, ids: &mut Vec<SampleId>) {
        ids.clear();
        while ids.len() < most && !self.is_empty() {
            // Samples of one set differ in their index alone.
            let left = u32::try_from(most - ids.len()).unwrap_or(u32::MAX);
            let first = self.next;
            let count = (self.pass.end - first.index).min(left);
            ids.extend((0..count).map(|i| SampleId { index: first.index + i, ..first }));
            self.advance(count);
        }
    }

    /// Goes on by `count` samples, at most those that are left of the set.
    fn advance(&mut self, count: u32) {
        self.next.index += count;
        if self.next.index < self.pass.end {
            return;
        }
        self.next.index = self.pass.start;
        self.next.set += 1;
        if self.next.set < self.sets {
            return;
        }
        self.next.set = 0;
        self.next.pixel.x += 1;
        if self.next.pixel.x == self.window.max.x {
            self.next.pixel = UVec2::new(self.window.min.x, self.next.pixel.y + 1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the wave's length, in the same order.
    #[test]
    fn samples_come_once_and_in_order() {
        let window = Window { min: UVec2::new(3, 5), max: UVec2::new(6, 7) };
        let (sets, pass) = (3, 2..7);
        let mut expected = Vec::new();
        for (y, x) in (5..7).flat_map(|y| (3..6).map(move |x| (y, x))) {
            for (set, index) in (0..3).flat_map(|set| (2..7).map(move |index| (set, index))) {
                expected.push(SampleId { pixel: UVec2::new(x, y), set, index });
            }
        }
        for most in [1, 4, 7, 15, 1000] {
            let mut samples = Samples::new(window, sets, pass.clone());
            let (mut all, mut wave) = (Vec::new(), Vec::new());
            while !samples.is_empty() {
                samples.fill(most, &mut wave);
                assert!(!wave.is_empty() && wave.len() <= most);
                all.extend_from_slice(&wave);
            }
            assert_eq!(all, expected, "waves of {most}");
        }
    }
}
