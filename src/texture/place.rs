//! [`Place`]: where a point lies among the pixels of an image.

use super::texels::Texels;
use crate::spectrum::Spectrum;

/// A point between four pixels.
#[derive(Clone, Copy, Default)]
pub(super) struct Place {
    pub x: [u32; 2],
    pub y: [u32; 2],
    /// Weights of the second column and of the second row.
    pub part: [f32; 2],
    /// Whether the point is finite.
    pub exists: bool,
}

impl Place {
    #[inline]
    pub fn value(&self, texels: &Texels) -> Spectrum {
        if !self.exists {
            Spectrum::BLACK
        } else if self.part == [0.0; 2] {
            texels.at(self.x[0], self.y[0])
        } else {
            texels.between(self.x, self.y, self.part)
        }
    }
}
