//! Pixels from codes of 8 or 16 bits, of PNG and JPEG files.

use ::image::{ImageDecoder, ImageError};
use glam::UVec2;

use super::memory::{Refusal, area, filled, reserve};
use super::{Encoding, Image};
use crate::spectrum::Spectrum;

/// Decodes to codes from 0 to 1. `unreadable` says that it is no such file.
pub fn decode(
    decoder: impl ImageDecoder,
    unreadable: impl Fn(ImageError) -> String,
) -> Result<Image, Refusal> {
    let (width, height) = decoder.dimensions();
    let size = UVec2::new(width, height);
    let color = decoder.color_type();
    let mut codes = filled(decoder.total_bytes(), 0_u8)?;
    decoder.read_image(&mut codes).map_err(unreadable)?;

    let channels = usize::from(color.channel_count());
    let bytes_per_code = usize::from(color.bytes_per_pixel()) / channels;
    let value = |code: &[u8]| match *code {
        [high, low] => f32::from(u16::from_ne_bytes([high, low])) / f32::from(u16::MAX),
        _ => f32::from(code[0]) / f32::from(u8::MAX),
    };
    let mut pixels = reserve(area(size))?;
    pixels.extend(codes.chunks_exact(channels * bytes_per_code).map(|pixel| {
        let band = |index: usize| value(&pixel[index * bytes_per_code..][..bytes_per_code]);
        // Grey with or without opacity, or three colours.
        if channels < 3 {
            Spectrum::splat(band(0))
        } else {
            Spectrum::new(band(0), band(1), band(2))
        }
    }));
    Ok(Image { size, pixels, variance: None, degrees_of_freedom: None, encoding: Encoding::Srgb })
}
