//! [`Samples`]: all samples of a pass over a tile.

use std::ops::Range;

use glam::UVec2;

use crate::image::Window;
use crate::sampling::SampleId;

/// The samples of a pass: pixel by pixel, row by row, in each pixel set by set, in each set by index.
///
/// The samples of a pixel are numbered across its sets in turn: number `n` is in set `n % sets` and has index `n / sets`
/// there. So sets differ by at most one sample, however many there are.
pub struct Samples {
    window: Window,
    sets: u32,
    pass: Range<u32>,
    next: SampleId,
    /// The index behind the last sample of the set of `next`.
    end: u32,
}

impl Samples {
    /// The samples whose numbers are in `pass`, which is not empty, of `sets` sets for each pixel of `window`.
    pub fn new(window: Window, sets: u32, pass: Range<u32>) -> Self {
        let first = SampleId { pixel: window.min, set: 0, index: 0 };
        let mut samples = Self { window, sets, pass, next: first, end: 0 };
        samples.begin_set(first);
        samples
    }

    /// The indices of the samples in `set`.
    fn indices(&self, set: u32) -> Range<u32> {
        let below = |number: u32| number.saturating_sub(set).div_ceil(self.sets);
        below(self.pass.start)..below(self.pass.end)
    }

    /// Goes on at the first sample of the set of `at`, or of the next set that has any.
    fn begin_set(&mut self, mut at: SampleId) {
        loop {
            if at.set == self.sets {
                (at.set, at.pixel.x) = (0, at.pixel.x + 1);
            }
            if at.pixel.x == self.window.max.x {
                at.pixel = UVec2::new(self.window.min.x, at.pixel.y + 1);
            }
            let indices = self.indices(at.set);
            if !indices.is_empty() {
                (self.next, self.end) = (SampleId { index: indices.start, ..at }, indices.end);
                return;
            }
            at.set += 1;
        }
    }

    /// Whether all have been handed out.
    pub fn is_empty(&self) -> bool {
        self.next.pixel.y >= self.window.max.y
    }

    /// Hands out the next `most`, or as many as there are, in place of what `ids` holds, and in `runs` how many in a row
    /// are of one set.
    pub fn fill(&mut self, most: usize, ids: &mut Vec<SampleId>, runs: &mut Vec<usize>) {
        ids.clear();
        runs.clear();
        while ids.len() < most && !self.is_empty() {
            // Samples of one set differ in their index alone.
            let left = u32::try_from(most - ids.len()).unwrap_or(u32::MAX);
            let first = self.next;
            let count = (self.end - first.index).min(left);
            ids.extend((0..count).map(|i| SampleId { index: first.index + i, ..first }));
            runs.push(count as usize);
            match first.index + count {
                index if index < self.end => self.next.index = index,
                _ => self.begin_set(SampleId { set: first.set + 1, ..first }),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the wave's length, in the same order; with passes that leave out sets, first, last and in the middle.
    #[test]
    fn samples_come_once_and_in_order() {
        let window = Window { min: UVec2::new(3, 5), max: UVec2::new(6, 7) };
        for (sets, pass) in
            [(3, 6..21), (3, 7..9), (3, 5..7), (1, 2..7), (4, 3..6), (5, 0..23), (7, 0..1)]
        {
            let mut expected = Vec::new();
            for (y, x) in (5..7).flat_map(|y| (3..6).map(move |x| (y, x))) {
                for set in 0..sets {
                    let of_set = pass.clone().filter(|number| number % sets == set);
                    let pixel = UVec2::new(x, y);
                    expected.extend(of_set.map(|n| SampleId { pixel, set, index: n / sets }));
                }
            }
            for most in [1, 4, 7, 15, 1000] {
                let mut samples = Samples::new(window, sets, pass.clone());
                let (mut all, mut wave, mut runs) = (Vec::new(), Vec::new(), Vec::new());
                while !samples.is_empty() {
                    samples.fill(most, &mut wave, &mut runs);
                    assert!(!wave.is_empty() && wave.len() <= most);
                    let of_sets = wave.chunk_by(|a, b| (a.pixel, a.set) == (b.pixel, b.set));
                    assert!(of_sets.map(<[_]>::len).eq(runs.iter().copied()), "{runs:?}");
                    all.extend_from_slice(&wave);
                }
                assert_eq!(all, expected, "waves of {most}, {pass:?} of {sets} sets");
            }
        }
    }

    /// The largest numbers do not overflow.
    #[test]
    fn numbers_reach_up_to_the_largest() {
        let window = Window::full(UVec2::ONE);
        let mut samples = Samples::new(window, 3, u32::MAX - 2..u32::MAX);
        let mut wave = Vec::new();
        samples.fill(9, &mut wave, &mut Vec::new());
        let places: Vec<_> = wave.iter().map(|id| (id.set, id.index)).collect();
        assert_eq!(places, [(1, 1_431_655_764), (2, 1_431_655_764)]);
        assert!(samples.is_empty());
    }
}
