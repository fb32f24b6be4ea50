//! PFM files (portable float map): three lines of text, then rows of `f32` from the bottom up.

use std::io::{BufRead, Read, Seek, SeekFrom};
use std::path::Path;

use glam::UVec2;

use super::atomic::write_file;
use super::memory::{PIXEL, Refusal, area, check, filled};
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
    write_file(path, &encode(picture))
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

/// The longest header that is read, in bytes.
const LONGEST: u64 = 256;

impl Header {
    /// Reads the header, and moves `source` to the pixels once it is known that they stay within the limit.
    fn read(source: &mut (impl BufRead + Seek), length: u64, limit: u64) -> Result<Self, Refusal> {
        let mut start = Vec::new();
        source.take(LONGEST).read_to_end(&mut start).map_err(|error| error.to_string())?;
        let mut rest = &start[..];
        let header = Self::parse(&mut rest)?;
        let text = (start.len() - rest.len()) as u64;
        let (size, row) = (header.size, header.row());
        // In 128 bits: sides have up to 31 each.
        let (expected, found) = (u128::from(row) * u128::from(size.y), length - text);
        if u128::from(found) != expected {
            let UVec2 { x, y } = size;
            return Err(format!("{x} x {y} pixels need {expected} bytes, not {found}").into());
        }
        check(size, PIXEL * u128::from(area(size)) + u128::from(row), limit)?;
        source.seek(SeekFrom::Start(text)).map_err(|error| error.to_string())?;
        Ok(header)
    }

    /// Moves `bytes` behind the header.
    fn parse(bytes: &mut &[u8]) -> Result<Self, String> {
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
        // As in PNG files: so no sum of a side and a margin leaves 32 bits.
        let is_side = |side: &u32| (1..=i32::MAX as u32).contains(side);
        let side = |word: &str| word.parse::<u32>().ok().filter(is_side);
        let (Some(width), Some(height)) = (side(columns), side(rows)) else {
            return Err(format!(
                "its size is `{columns} {rows}`, expected columns and rows, both from 1 to {}",
                i32::MAX
            ));
        };
        let scale: f32 =
            scale.parse().map_err(|_| format!("its scale is `{scale}`, expected a number"))?;
        Ok(Self { bands, size: UVec2::new(width, height), is_little_endian: scale < 0.0 })
    }

    /// Bytes of a row.
    fn row(&self) -> u64 {
        4 * self.bands as u64 * u64::from(self.size.x)
    }
}

/// Columns and rows.
pub(super) fn size(
    mut source: impl BufRead + Seek,
    length: u64,
    limit: u64,
) -> Result<UVec2, Refusal> {
    Ok(Header::read(&mut source, length, limit)?.size)
}

/// Decodes a PFM file. The magnitude of the scale, a unit of radiance that few programs write, is ignored.
pub(super) fn decode(
    mut source: impl BufRead + Seek,
    length: u64,
    limit: u64,
) -> Result<Image, Refusal> {
    let header = Header::read(&mut source, length, limit)?;
    let mut bytes = filled(header.row(), 0_u8)?;
    let mut pixels = filled(area(header.size), Spectrum::BLACK)?;
    let value = |bytes: &[u8; 4]| match header.is_little_endian {
        true => f32::from_le_bytes(*bytes),
        false => f32::from_be_bytes(*bytes),
    };
    for row in pixels.chunks_exact_mut(header.size.x as usize).rev() {
        source.read_exact(&mut bytes).map_err(|error| error.to_string())?;
        let found = bytes.as_chunks::<4>().0.chunks_exact(header.bands);
        for (pixel, bands) in row.iter_mut().zip(found) {
            *pixel = match bands {
                [r, g, b] => Spectrum::new(value(r), value(g), value(b)),
                _ => Spectrum::splat(value(&bands[0])),
            };
        }
    }
    Ok(Image {
        size: header.size,
        pixels,
        variance: None,
        degrees_of_freedom: None,
        encoding: Encoding::Linear,
    })
}

/// Takes the next word, and the one byte of white space after it.
fn next_word<'a>(bytes: &mut &'a [u8]) -> Option<&'a str> {
    let start = bytes.iter().position(|byte| !byte.is_ascii_whitespace())?;
    let end = start + bytes[start..].iter().position(|byte| byte.is_ascii_whitespace())?;
    let word = str::from_utf8(&bytes[start..end]).ok()?;
    *bytes = &bytes[end + 1..];
    Some(word)
}
