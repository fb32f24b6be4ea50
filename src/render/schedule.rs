//! [`PassSchedule`]: which samples of a pixel are taken in which pass.

use std::ops::Range;

use crate::clock::Stopwatch;

/// The passes of a render, as ranges of a pixel's samples: each takes as many as all before it, as far as time allows.
pub struct PassSchedule {
    end: u32,
    /// Limit in seconds, if there is one.
    time: Option<f64>,
    /// Seconds that were spent before `start`.
    before: f64,
    start: Stopwatch,
    first: u32,
    next: u32,
}

impl PassSchedule {
    /// Samples in the first pass, where time is not limited. Many together trace rays faster: two passes of 8 take 5 to 8 %
    /// more instructions than one of 16.
    const FIRST: u32 = 64;
    /// From so many samples on the first pass takes a single one, as where time is limited: the passes up to 64 then cost
    /// less than a hundredth of the render, and a render that is ended early has a whole picture.
    const MANY: u32 = 1024;

    /// The passes of `samples`, from the one that begins at `next` on, within `time` seconds, of which `before` are over.
    pub fn new(samples: Range<u32>, next: u32, time: Option<f64>, before: f64) -> Self {
        let start = Stopwatch::start();
        Self { end: samples.end, time, before, start, first: samples.start, next }
    }

    /// The next pass; `None` when nothing is left of samples or time.
    pub fn next(&mut self) -> Option<Range<u32>> {
        let taken = self.next - self.first;
        let is_long = self.time.is_some() || self.end - self.first >= Self::MANY;
        let doubled = match taken {
            0 if is_long => 1,
            0 => Self::FIRST,
            taken => 1 << taken.ilog2(),
        };
        let size = match self.time {
            Some(time) if taken > 0 => self.affordable(doubled, time),
            _ => doubled,
        };
        let pass = self.next..self.next + size.min(self.end - self.next);
        self.next = pass.end;
        (!pass.is_empty()).then_some(pass)
    }

    /// The largest power of two up to `size` that is likely to end in time, by what samples took so far; 0 if none is.
    fn affordable(&self, mut size: u32, time: f64) -> u32 {
        let elapsed = self.before + self.start.seconds();
        let affordable = (time - elapsed) / (elapsed / f64::from(self.next - self.first));
        while size > 0 && f64::from(size) > affordable {
            size >>= 1;
        }
        size
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All passes until there are no more.
    fn passes(samples: Range<u32>, next: u32, time: Option<f64>) -> Vec<u32> {
        let (mut schedule, mut end) = (PassSchedule::new(samples, next, time, 0.0), next);
        let sizes = std::iter::from_fn(|| schedule.next()).map(|pass| {
            assert_eq!(pass.start, end, "samples are left out or taken twice");
            end = pass.end;
            pass.len() as u32
        });
        sizes.collect()
    }

    /// Doubled until the limit; from 1 on where time is limited.
    #[test]
    fn passes_double_up_to_the_limit() {
        let long = Some(1e9);
        assert_eq!(passes(0..7, 0, long), [1, 1, 2, 3]);
        assert_eq!(passes(0..1, 0, long), [1]);
        assert_eq!(passes(0..300, 0, None), [64, 64, 128, 44]);
        assert_eq!(passes(0..7, 0, None), [7]);
        assert_eq!(passes(5..1029, 5, None), [1, 1, 2, 4, 8, 16, 32, 64, 128, 256, 512]);
        assert_eq!(passes(0..u32::MAX, 0, Some(1e-9)), [1]);
        // A part of the samples has the passes of as many; a render that goes on has those that are left.
        assert_eq!(passes(100..250, 100, None), [64, 64, 22]);
        assert_eq!(passes(0..256, 64, None), [64, 128]);
        assert_eq!(passes(0..64, 64, None), []);
        // Of a hundred seconds, 99 went into 8 samples before; a hundred hours leave room.
        let after = |time| PassSchedule::new(0..64, 8, Some(time), 99.0).next();
        assert_eq!(after(100.0), None);
        assert_eq!(after(360_000.0), Some(8..16));
        // Powers of two, whatever was taken.
        assert_eq!(passes(0..64, 12, None), [8, 16, 28]);
        assert_eq!(passes(u32::MAX - 65..u32::MAX, u32::MAX - 65, None), [64, 1]);
        assert_eq!(passes(0..u32::MAX, 1 << 31, None), [u32::MAX >> 1]);
    }
}
