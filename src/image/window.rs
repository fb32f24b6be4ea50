//! [`Window`]: a rectangle of pixels.

use glam::UVec2;

/// A rectangle of pixels: `min` is inclusive, `max` exclusive. x grows to the right, y downwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// The first column and row.
    pub min: UVec2,
    /// One past the last column and row.
    pub max: UVec2,
}

impl Window {
    /// The window that covers a whole image of this size.
    pub const fn full(resolution: UVec2) -> Self {
        Self { min: UVec2::ZERO, max: resolution }
    }

    /// Columns and rows.
    pub fn size(&self) -> UVec2 {
        self.max - self.min
    }

    /// Number of pixels.
    pub fn area(&self) -> usize {
        self.size().x as usize * self.size().y as usize
    }
}
