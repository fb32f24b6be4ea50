//! [`TexelsError`]: why an image cannot be looked up.

use glam::UVec2;

use crate::spectrum::Spectrum;

/// Why an image cannot be looked up.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TexelsError {
    /// No pixels, or not one for each place.
    #[error("{pixels} pixels for {} x {}, expected one for each, and at least one", size.x, size.y)]
    Size {
        /// Columns and rows.
        size: UVec2,
        /// Pixels that there are.
        pixels: usize,
    },
    /// A pixel that is NaN, infinite or negative.
    #[error(
        "the pixel of column {} and row {}, which count from 0 at the top left, is {:?}, expected finite numbers of at least 0",
        at.x, at.y, value.to_array()
    )]
    Pixel {
        /// Column and row, from 0 at the top left.
        at: UVec2,
        /// What it holds.
        value: Spectrum,
    },
    /// This many bytes are not available.
    #[error("{} MiB of memory are not available", .0.div_ceil(1 << 20))]
    OutOfMemory(u64),
}
