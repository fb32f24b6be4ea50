//! [`Channel`]: numbers from a texture of colours.

use super::Texture;
use crate::interaction::{BLOCK, HitBlock, SurfaceInteraction};
use crate::spectrum::Spectrum;

/// What of a colour is a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// The red band.
    Red,
    /// The green band.
    Green,
    /// The blue band.
    Blue,
    /// The luminance of Rec. 709.
    Luminance,
}

impl Channel {
    #[inline]
    fn of(self, color: Spectrum) -> f32 {
        let [r, g, b] = color.to_array();
        match self {
            Self::Red => r,
            Self::Green => g,
            Self::Blue => b,
            Self::Luminance => color.luminance(),
        }
    }
}

/// One channel of a texture.
#[derive(Clone)]
pub(super) struct OfChannel<X> {
    pub colors: X,
    pub channel: Channel,
}

impl<X: Texture<Spectrum>> Texture<f32> for OfChannel<X> {
    fn evaluate(&self, si: &SurfaceInteraction) -> f32 {
        self.channel.of(self.colors.evaluate(si))
    }

    fn evaluate_block(&self, hits: &HitBlock, values: &mut [f32]) {
        // What a texture leaves out shows.
        let mut colors = [Spectrum::splat(f32::NAN); BLOCK];
        self.colors.evaluate_block(hits, &mut colors[..values.len()]);
        for (value, color) in values.iter_mut().zip(colors) {
            *value = self.channel.of(color);
        }
    }
}
