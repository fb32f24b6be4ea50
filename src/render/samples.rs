//! [`Samples`]: all samples of a pass over a tile, one by one.

use std::ops::Range;

use glam::UVec2;

use crate::film::Window;
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
}

impl Iterator for Samples {
    type Item = SampleId;

    #[inline]
    fn next(&mut self) -> Option<SampleId> {
        if self.is_empty() {
            return None;
        }
        let id = self.next;
        self.next.index += 1;
        if self.next.index == self.pass.end {
            self.next.index = self.pass.start;
            self.next.set += 1;
            if self.next.set == self.sets {
                self.next.set = 0;
                self.next.pixel.x += 1;
                if self.next.pixel.x == self.window.max.x {
                    self.next.pixel = UVec2::new(self.window.min.x, id.pixel.y + 1);
                }
            }
        }
        Some(id)
    }
}
