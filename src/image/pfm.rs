//! PFM files (portable float map): three lines of text, then rows of `f32` from the bottom up.

use std::io::Write;
use std::path::Path;

use glam::UVec2;

use super::atomic::replace;
use super::{Encoding, Image, Picture, WriteError};
use crate::spectrum::Spectrum;

/// Writes the window of a picture as a PFM file: linear radiance in three bands, little-endian `f32`, bit for bit. The
/// format has no room for variance, layers or metadata.
///
/// The file is replaced whole or not at all, as [`write_file`](super::write_file) says.
///
/// # Errors
/// When the path cannot be written, or the parts of the picture contradict each other.
pub fn write_pfm(path: impl AsRef<Path>, picture: &Picture) -> Result<(), WriteError> {
    let path = path.as_ref();
    picture.check().map_err(|error| WriteError::Picture { path: path.to_owned(), error })?;
    replace(path, |file| file.write_all(&encode(picture)))
}

/// The bytes of the file. A negative scale says that the numbers are little-endian.
fn encode(picture: &Picture) -> Vec<u8> {
    let size = picture.window.size();
    let mut bytes = format!("PF\n{} {}\n-1.0\n", size.x, size.y).into_bytes();
    for row in picture.color.chunks_exact(size.x as usize).rev() {
        bytes.extend(row.iter().flat_map(|pixel| pixel.to_array()).flat_map(f32::to_le_bytes));
    }
    bytes
}

/// The text at the beginning of a file.
struct Header {
    /// 3 bands for `PF`, 1 for `Pf`.
    bands: usize,
    size: UVec2,
    is_little_endian: bool,
}

impl Header {
    /// Reads the header and moves `bytes` to the pixels.
    fn read(bytes: &mut &[u8]) -> Result<Self, String> {
        let mut words = [""; 4];
        for word in &mut words {
            *word = next_word(bytes).ok_or("it ends within its header")?;
        }
        let [magic, columns, rows, scale] = words;
        let bands = match magic {
            "PF" => 3,
            "Pf" => 1,
            _ => {
                return Err(format!(
                    "it is not a PFM file: it begins with `{magic}`, not PF or Pf"
                ));
            }
        };
        let side = |word: &str| word.parse::<u32>().ok().filter(|&side| side > 0);
        let (Some(width), Some(height)) = (side(columns), side(rows)) else {
            return Err(format!(
                "its size is `{columns} {rows}`, expected columns and rows, both at least 1"
            ));
        };
        let scale: f32 =
            scale.parse().map_err(|_| format!("its scale is `{scale}`, expected a number"))?;
        Ok(Self { bands, size: UVec2::new(width, height), is_little_endian: scale < 0.0 })
    }
}

/// Decodes a PFM file. The magnitude of the scale, a unit of radiance that few programs write, is ignored.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, String> {
    let mut rest = bytes;
    let Header { bands, size, is_little_endian } = Header::read(&mut rest)?;
    // In 128 bits: sides have up to 32 each.
    let expected = 4 * u128::from(size.x) * u128::from(size.y) * bands as u128;
    let found = rest.len();
    if found as u128 != expected {
        return Err(format!("{} x {} pixels need {expected} bytes, not {found}", size.x, size.y));
    }
    let value = |bytes: &[u8; 4]| match is_little_endian {
        true => f32::from_le_bytes(*bytes),
        false => f32::from_be_bytes(*bytes),
    };
    let values: Vec<f32> = rest.as_chunks::<4>().0.iter().map(value).collect();
    let pixel = |of: &[f32]| match of {
        [r, g, b] => Spectrum::new(*r, *g, *b),
        _ => Spectrum::splat(of[0]),
    };
    let row = |row: &[f32]| row.chunks(bands).map(pixel).collect::<Vec<_>>();
    let pixels = values.chunks(size.x as usize * bands).rev().flat_map(row).collect();
    Ok(Image { size, pixels, variance: None, degrees_of_freedom: None, encoding: Encoding::Linear })
}

/// Takes the next word, and the one byte of white space after it.
fn next_word<'a>(bytes: &mut &'a [u8]) -> Option<&'a str> {
    let start = bytes.iter().position(|byte| !byte.is_ascii_whitespace())?;
    let end = start + bytes[start..].iter().position(|byte| byte.is_ascii_whitespace())?;
    let word = str::from_utf8(&bytes[start..end]).ok()?;
    *bytes = &bytes[end + 1..];
    Some(word)
}
