//! [`EnvironmentError`]: why an image cannot be an environment map.

use glam::{Quat, UVec2};

use crate::spectrum::Spectrum;
use crate::texture::TexelsError;

/// Why an image cannot be an environment map.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EnvironmentError {
    /// No pixels, or not one for each place.
    #[error("{pixels} pixels for {} x {}, expected one for each, and at least one", size.x, size.y)]
    Size {
        /// Columns and rows.
        size: UVec2,
        /// Pixels that there are.
        pixels: usize,
    },
    /// A pixel that is NaN, infinite or negative.
    #[error("pixel ({}, {}) is {}, expected radiance that is finite and at least 0", at.x, at.y, bands(value))]
    Pixel {
        /// Column and row, from 0 at the top left.
        at: UVec2,
        /// What it holds.
        value: Spectrum,
    },
    /// A pixel that the scale makes infinite.
    #[error("pixel ({}, {}) is {}, which a scale of {} makes infinite", at.x, at.y, bands(value), bands(scale))]
    Overflow {
        /// Column and row, from 0 at the top left.
        at: UVec2,
        /// What it holds.
        value: Spectrum,
        /// The scale.
        scale: Spectrum,
    },
    /// A scale that is NaN, infinite or negative.
    #[error("the scale is {}, expected to be finite and at least 0", bands(.0))]
    Scale(Spectrum),
    /// This many bytes are not available.
    #[error("{} MiB of memory are not available", .0.div_ceil(1 << 20))]
    OutOfMemory(u64),
    /// A rotation that is not of unit length.
    #[error("{0} is not a rotation")]
    Rotation(Quat),
}

impl From<TexelsError> for EnvironmentError {
    fn from(error: TexelsError) -> Self {
        match error {
            TexelsError::Size { size, pixels } => Self::Size { size, pixels },
            TexelsError::Pixel { at, value } => Self::Pixel { at, value },
            TexelsError::OutOfMemory(bytes) => Self::OutOfMemory(bytes),
        }
    }
}

fn bands(spectrum: &Spectrum) -> String {
    format!("{:?}", spectrum.to_array())
}
