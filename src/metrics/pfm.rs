//! Portable float maps: three lines of text, then the rows from the bottom up.

use glam::UVec2;

use super::{Encoding, Image};
use crate::spectrum::Spectrum;

/// Reads a PFM file: `PF` or, for one band, `Pf`; columns and rows; the scale, whose sign says the byte order.
pub fn decode(bytes: &[u8]) -> Result<Image, String> {
    let mut rest = bytes;
    let mut words = [""; 4];
    for word in &mut words {
        *word = next_word(&mut rest).ok_or("it ends within its head")?;
    }
    let bands = match words[0] {
        "PF" => 3,
        "Pf" => 1,
        other => return Err(format!("it is no PFM file: it begins with `{other}`, not PF or Pf")),
    };
    let number = |word: &str| word.parse::<u32>().ok().filter(|&n| n > 0);
    let (Some(width), Some(height)) = (number(words[1]), number(words[2])) else {
        return Err(format!("`{} {}` is no size", words[1], words[2]));
    };
    let scale: f32 = words[3].parse().map_err(|_| format!("`{}` is no scale", words[3]))?;
    let count = u64::from(width) * u64::from(height) * bands;
    if rest.len() as u64 != 4 * count {
        let found = rest.len();
        return Err(format!("{width} x {height} pixels need {} bytes, not {found}", 4 * count));
    }
    let value = |bytes: &[u8; 4]| match scale < 0.0 {
        true => f32::from_le_bytes(*bytes),
        false => f32::from_be_bytes(*bytes),
    };
    let values: Vec<f32> = rest.as_chunks::<4>().0.iter().map(value).collect();
    let pixel = |of: &[f32]| match of {
        [r, g, b] => Spectrum::new(*r, *g, *b),
        _ => Spectrum::splat(of[0]),
    };
    let row = |row: &[f32]| row.chunks(bands as usize).map(pixel).collect::<Vec<_>>();
    let rows = values.chunks(width as usize * bands as usize).rev();
    let pixels = rows.flat_map(row).collect();
    let size = UVec2::new(width, height);
    Ok(Image { size, pixels, variance: None, encoding: Encoding::Linear })
}

/// The next word, and what comes after the one byte of space behind it.
fn next_word<'a>(bytes: &mut &'a [u8]) -> Option<&'a str> {
    let start = bytes.iter().position(|byte| !byte.is_ascii_whitespace())?;
    let end = start + bytes[start..].iter().position(|byte| byte.is_ascii_whitespace())?;
    let word = str::from_utf8(&bytes[start..end]).ok()?;
    *bytes = &bytes[end + 1..];
    Some(word)
}
