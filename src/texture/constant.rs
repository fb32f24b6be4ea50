//! [`ConstantTexture`]: the same value everywhere.

use super::Texture;
use crate::interaction::SurfaceInteraction;

/// The same value at every point. It needs no texture coordinates and no filtering.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantTexture<T> {
    value: T,
}

impl<T> ConstantTexture<T> {
    /// A texture of this value.
    pub const fn new(value: T) -> Self {
        Self { value }
    }
}

impl<T: Copy + Send + Sync> Texture<T> for ConstantTexture<T> {
    #[inline]
    fn evaluate(&self, _si: &SurfaceInteraction) -> T {
        self.value
    }

    fn constant(&self) -> Option<T> {
        Some(self.value)
    }
}
