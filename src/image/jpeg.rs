//! JPEG files, for textures.

use std::io::{BufRead, Seek};

use ::image::codecs::jpeg::JpegDecoder;
use ::image::{ImageDecoder, ImageError};
use glam::UVec2;

use super::memory::{PIXEL, Refusal, area, check};
use super::{Image, codes};

/// Reads what stands before the pixels, which stay within the limit. `length` is that of the file, all of which is read.
fn open<R: BufRead + Seek>(source: R, length: u64, limit: u64) -> Result<JpegDecoder<R>, Refusal> {
    let decoder = JpegDecoder::new(source).map_err(unreadable)?;
    let (width, height) = decoder.dimensions();
    let size = UVec2::new(width, height);
    // The file, coefficients of a progressive one (two bytes for each of three bands), codes and pixels.
    let coefficients = 6 * u128::from(area(size));
    let codes = u128::from(decoder.total_bytes());
    check(size, u128::from(length) + coefficients + codes + PIXEL * u128::from(area(size)), limit)?;
    Ok(decoder)
}

fn unreadable(error: ImageError) -> String {
    format!("it is not a JPEG file: {error}")
}

/// Columns and rows.
pub fn size(source: impl BufRead + Seek, length: u64, limit: u64) -> Result<UVec2, Refusal> {
    let (width, height) = open(source, length, limit)?.dimensions();
    Ok(UVec2::new(width, height))
}

/// Decodes a JPEG file to codes from 0 to 1.
pub fn decode(source: impl BufRead + Seek, length: u64, limit: u64) -> Result<Image, Refusal> {
    codes::decode(open(source, length, limit)?, unreadable)
}
