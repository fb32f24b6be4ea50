//! [`Tiles`]: the image cut into tiles, which threads take one by one.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::UVec2;

use crate::image::Window;

/// The tiles of a window, handed out row by row to whichever thread asks next.
pub struct Tiles {
    window: Window,
    size: u32,
    grid: UVec2,
    next: AtomicUsize,
}

impl Tiles {
    /// Cuts `window` into squares of `size` pixels, smaller at the right and at the bottom.
    pub fn new(window: Window, size: u32) -> Self {
        let size = size.max(1);
        let grid = UVec2::new(window.size().x.div_ceil(size), window.size().y.div_ceil(size));
        Self { window, size, grid, next: AtomicUsize::new(0) }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.grid.x as usize * self.grid.y as usize
    }

    /// The next tile with its number, or `None` when all have been handed out.
    pub fn next(&self) -> Option<(usize, Window)> {
        let index = self.next.fetch_add(1, Ordering::Relaxed);
        (index < self.count()).then(|| (index, self.window(index)))
    }

    /// The pixels of a tile.
    pub fn window(&self, index: usize) -> Window {
        let columns = self.grid.x as usize;
        let cell = UVec2::new((index % columns) as u32, (index / columns) as u32);
        let min = self.window.min + cell * self.size;
        // Saturating: a tile may be asked to be larger than any image.
        let max = UVec2::new(min.x.saturating_add(self.size), min.y.saturating_add(self.size));
        Window { min, max: max.min(self.window.max) }
    }
}
