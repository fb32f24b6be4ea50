//! JPEG files, for textures.

use std::io::{self, BufRead, Read, Seek};

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
    // The file, coefficients of a progressive one (two bytes for each of four bands), codes and pixels.
    let coefficients = 8 * u128::from(area(size));
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
pub fn decode(mut source: impl BufRead + Seek, length: u64, limit: u64) -> Result<Image, Refusal> {
    let is_whole = is_whole(&mut source).and_then(|is_whole| source.rewind().map(|()| is_whole));
    // An error of the header comes first.
    let decoder = open(source, length, limit)?;
    if !is_whole.map_err(|error| error.to_string())? {
        return Err("it is incomplete: it has no end marker".into());
    }
    codes::decode(decoder, unreadable)
}

/// Whether the segments lead to the marker of the end (ITU-T T.81, annex B). The decoder would fill with grey what is missing.
fn is_whole(mut source: impl BufRead) -> io::Result<bool> {
    loop {
        if source.skip_until(0xFF)? == 0 {
            return Ok(false);
        }
        // A marker may have any number of fill bytes before it.
        let mut marker = [0xFF];
        while marker == [0xFF] {
            if source.read(&mut marker)? == 0 {
                return Ok(false);
            }
        }
        match marker[0] {
            0xD9 => return Ok(true),
            // A stuffed byte, and markers without a segment: TEM, RSTn, SOI.
            0x00 | 0x01 | 0xD0..=0xD8 => {}
            _ => {
                let mut length = [0; 2];
                for byte in length.chunks_mut(1) {
                    if source.read(byte)? == 0 {
                        return Ok(false);
                    }
                }
                let rest = u64::from(u16::from_be_bytes(length)).saturating_sub(2);
                io::copy(&mut source.by_ref().take(rest), &mut io::sink())?;
            }
        }
    }
}
