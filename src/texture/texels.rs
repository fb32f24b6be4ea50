//! [`Texels`]: the pixels of image textures.

use glam::UVec2;

use crate::image::{Display, Encoding, Image};
use crate::params::Choice;
use crate::spectrum::Spectrum;

/// What the codes of an image mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Curve {
    /// Codes of the sRGB curve (IEC 61966-2-1).
    Srgb,
    /// Codes to the power of 2.2, as older programs take them.
    Gamma22,
    /// Numbers as they are: roughness, heights, radiance.
    Linear,
}

impl Choice for Curve {
    const CHOICES: &'static [(&'static str, Self)] =
        &[("srgb", Self::Srgb), ("gamma-2.2", Self::Gamma22), ("linear", Self::Linear)];
}

impl Curve {
    /// What a code in `[0, 1]` stands for.
    pub fn decode(self, code: f32) -> f32 {
        self.decoded(f64::from(code))
    }

    fn decoded(self, code: f64) -> f32 {
        let value = match self {
            Self::Srgb => Display::Srgb.decode(code),
            Self::Gamma22 => code.powf(2.2),
            Self::Linear => code,
        };
        value as f32
    }
}

/// An image in memory for lookups: 4 bytes a pixel if its codes have 8 bits, else 12. Row 0 is at the top.
pub struct Texels {
    size: UVec2,
    pixels: Pixels,
}

enum Pixels {
    /// Codes, and what each stands for.
    Codes(Vec<[u8; 4]>, Box<[f32; 256]>),
    Values(Vec<[f32; 3]>),
}

impl Texels {
    /// Of an image. `curve` holds for files with codes; those with radiance are linear.
    pub fn new(image: &Image, curve: Curve) -> Self {
        let is_linear = image.encoding == Encoding::Linear;
        let code = |x: f32| (x * 255.0).round();
        let is_code = |pixel: &Spectrum| pixel.to_array().iter().all(|&x| code(x) / 255.0 == x);
        let pixels = if !is_linear && image.pixels.iter().all(is_code) {
            let codes = image.pixels.iter().map(|pixel| {
                let [r, g, b] = pixel.to_array().map(|x| code(x) as u8);
                [r, g, b, 0]
            });
            let meanings = std::array::from_fn(|code| curve.decoded(code as f64 / 255.0));
            Pixels::Codes(codes.collect(), Box::new(meanings))
        } else {
            let curve = if is_linear { Curve::Linear } else { curve };
            let value = |pixel: &Spectrum| pixel.to_array().map(|code| curve.decode(code));
            Pixels::Values(image.pixels.iter().map(value).collect())
        };
        Self { size: image.size, pixels }
    }

    /// What keeps an image from being a texture: a value that is negative or not finite.
    pub(super) fn check(image: &Image) -> Result<(), String> {
        let is_sound =
            |pixel: &Spectrum| pixel.to_array().iter().all(|x| x.is_finite() && *x >= 0.0);
        let Some(index) = image.pixels.iter().position(|pixel| !is_sound(pixel)) else {
            return Ok(());
        };
        let width = image.size.x as usize;
        let (x, y, found) = (index % width, index / width, image.pixels[index].to_array());
        Err(format!(
            "the pixel of column {x} and row {y}, which count from 0 at the top left, is {found:?}, \
             expected finite numbers of at least 0"
        ))
    }

    /// Columns and rows.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        match &self.pixels {
            Pixels::Codes(codes, meanings) => size_of_val(&codes[..]) + size_of_val(&meanings[..]),
            Pixels::Values(values) => size_of_val(&values[..]),
        }
    }

    /// CRC-32 of the size and all values.
    #[cfg(feature = "scene-file")]
    pub(crate) fn checksum(&self) -> u32 {
        let mut sum = crc32fast::Hasher::new();
        let mut add = |numbers: &[[u8; 4]]| sum.update(numbers.as_flattened());
        add(&self.size.to_array().map(u32::to_le_bytes));
        match &self.pixels {
            Pixels::Codes(codes, meanings) => {
                add(&meanings.map(f32::to_le_bytes));
                add(codes);
            }
            Pixels::Values(values) => {
                values.iter().for_each(|value| add(&value.map(f32::to_le_bytes)));
            }
        }
        sum.finalize()
    }

    /// The value of a pixel.
    ///
    /// # Panics
    /// If there is no such pixel.
    #[inline]
    pub fn at(&self, x: u32, y: u32) -> Spectrum {
        let index = y as usize * self.size.x as usize + x as usize;
        match &self.pixels {
            Pixels::Codes(codes, meanings) => {
                let [r, g, b, _] = codes[index].map(|code| meanings[usize::from(code)]);
                Spectrum::new(r, g, b)
            }
            Pixels::Values(values) => values[index].into(),
        }
    }
}
