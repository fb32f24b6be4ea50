//! [`Image`]: pixels as a file holds them.

use glam::UVec2;

use super::Picture;
use crate::spectrum::Spectrum;

/// What the numbers of an image mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Encoding {
    /// Linear radiance: EXR and PFM files.
    Linear,
    /// Codes of a screen, divided by the largest code so that they lie in `[0, 1]`: PNG and JPEG files.
    Srgb,
}

/// Pixels with three bands, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Columns and rows, at least one of each.
    pub size: UVec2,
    /// One value for each pixel.
    pub pixels: Vec<Spectrum>,
    /// Square of each pixel's standard error, if it is known.
    pub variance: Option<Vec<Spectrum>>,
    /// Degrees of freedom of each variance, as in [`Picture`]; `None` if they are not known.
    pub degrees_of_freedom: Option<u32>,
    /// What the numbers mean.
    pub encoding: Encoding,
}

impl From<&Picture> for Image {
    /// The window of the picture, without its layers.
    fn from(picture: &Picture) -> Self {
        Self {
            size: picture.window.size(),
            pixels: picture.color.clone(),
            variance: picture.variance.clone(),
            degrees_of_freedom: picture.degrees_of_freedom,
            encoding: Encoding::Linear,
        }
    }
}
