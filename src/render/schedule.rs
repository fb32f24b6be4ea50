//! [`PassSchedule`]: which samples of a set are taken in which pass.

use std::ops::Range;
use std::time::Duration;

use crate::clock::Stopwatch;

/// The passes of a render, as ranges of sample indices: one pass with all samples, or with a time limit powers of two.
pub struct PassSchedule {
    limit: u32,
    time: Option<Duration>,
    start: Stopwatch,
    scheduled: u32,
}

impl PassSchedule {
    /// Up to `limit` samples in a set, within `time` from now on. The first pass is taken in any case.
    pub fn new(limit: u32, time: Option<Duration>) -> Self {
        Self { limit: limit.max(1), time, start: Stopwatch::start(), scheduled: 0 }
    }

    /// The next pass; `None` when nothing is left of samples or time.
    pub fn next(&mut self) -> Option<Range<u32>> {
        let size = match self.time {
            None => self.limit - self.scheduled,
            Some(time) => self.fitting(self.start.seconds(), time.as_secs_f64()),
        };
        let pass = self.scheduled..self.scheduled + size;
        self.scheduled = pass.end;
        (size > 0).then_some(pass)
    }

    /// As many samples as earlier passes took, or the largest power of two below that is likely to end in time, by
    /// what samples took so far.
    fn fitting(&self, elapsed: f64, time: f64) -> u32 {
        let left = self.limit - self.scheduled;
        if self.scheduled == 0 {
            return 1;
        }
        let affordable = (time - elapsed) / (elapsed / f64::from(self.scheduled));
        let mut size = 1 << self.scheduled.ilog2();
        while size > 0 && f64::from(size) > affordable {
            size >>= 1;
        }
        size.min(left)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All sizes until there are no more.
    fn sizes(limit: u32, time: Option<Duration>) -> Vec<u32> {
        let (mut schedule, mut end) = (PassSchedule::new(limit, time), 0);
        let sizes = std::iter::from_fn(|| schedule.next()).map(|pass| {
            assert_eq!(pass.start, end, "samples are left out or taken twice");
            end = pass.end;
            pass.len() as u32
        });
        sizes.collect()
    }

    /// Doubled until the limit, or one pass where time allows no more.
    #[test]
    fn passes_double_up_to_the_limit() {
        let long = Some(Duration::from_secs(1 << 20));
        assert_eq!(sizes(7, long), [1, 1, 2, 3]);
        assert_eq!(sizes(1, long), [1]);
        assert_eq!(sizes(64, None), [64]);
        assert_eq!(sizes(0, None), [1]);
        assert_eq!(sizes(u32::MAX, Some(Duration::from_nanos(1))), [1]);
    }
}
