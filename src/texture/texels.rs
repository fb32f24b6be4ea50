//! [`Texels`]: the pixels of image textures.

use std::sync::OnceLock;

use arrayvec::ArrayVec;
use glam::UVec2;

use super::texels_error::TexelsError;
use crate::image::{Display, Encoding, Image, try_reserve};
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
///
/// Pixels are kept in tiles of 4 x 4, so that the four of a lookup are most often in one line of the cache.
pub struct Texels {
    size: UVec2,
    /// Tiles in a row.
    tiles: u32,
    pixels: Pixels,
    /// Halved again and again, if a texture filters.
    smaller: OnceLock<Vec<Self>>,
}

enum Pixels {
    /// Codes, and what each stands for.
    Codes(Vec<Tile<[u8; 4]>>, Box<[f32; 256]>),
    Values(Vec<Tile<[f32; 3]>>),
}

#[derive(Clone, Copy)]
#[repr(align(64))]
struct Tile<T>([T; 16]);

/// For each of `few` pixels of a row, which of `many` it covers and the fraction of each.
fn covered(many: u32, few: u32) -> Vec<ArrayVec<(u32, f32), 3>> {
    let scale = f64::from(many) / f64::from(few);
    let of_pixel = |i: u32| {
        let [from, to] = [scale * f64::from(i), scale * f64::from(i + 1)];
        let part = |j: u32| {
            let within = to.min(f64::from(j + 1)) - from.max(f64::from(j));
            (within > 1e-6).then_some((j, (within / scale) as f32))
        };
        (from as u32..many.min(from as u32 + 4)).filter_map(part).take(3).collect()
    };
    (0..few).map(of_pixel).collect()
}

/// Pixels in tiles, row by row; those beyond the edges are not looked up.
fn tiled<T: Copy>(size: UVec2, pixel: impl Fn(usize) -> T) -> Result<Vec<Tile<T>>, TexelsError> {
    let [width, height] = [size.x, size.y].map(|x| x as usize);
    let tile = |tile: usize| {
        let (tile_y, tile_x) = (tile / width.div_ceil(4), tile % width.div_ceil(4));
        Tile(std::array::from_fn(|i| {
            let (x, y) = (4 * tile_x + i % 4, 4 * tile_y + i / 4);
            pixel(y.min(height - 1) * width + x.min(width - 1))
        }))
    };
    let count = width.div_ceil(4) * height.div_ceil(4);
    let mut tiles = try_reserve(count as u64).map_err(TexelsError::OutOfMemory)?;
    tiles.extend((0..count).map(tile));
    Ok(tiles)
}

/// A pixel's place by its index.
fn place(size: UVec2, index: usize) -> UVec2 {
    let width = size.x as usize;
    UVec2::new((index % width) as u32, (index / width) as u32)
}

impl Texels {
    /// Bytes of a pixel, at most.
    pub(crate) const BYTES: u64 = 12;

    /// Of an image. `curve` holds for files with codes; those with radiance are linear.
    ///
    /// # Errors
    /// If the image has not one pixel for each place, and at least one; if a value is negative or not finite; or if memory is not available.
    pub fn new(image: &Image, curve: Curve) -> Result<Self, TexelsError> {
        let Image { size, ref pixels, .. } = *image;
        let area = u64::from(size.x) * u64::from(size.y);
        if pixels.len() as u64 != area || area == 0 {
            return Err(TexelsError::Size { size, pixels: pixels.len() });
        }
        if let Some(index) = pixels.iter().position(|pixel| !pixel.is_valid()) {
            return Err(TexelsError::Pixel { at: place(size, index), value: pixels[index] });
        }
        let is_linear = image.encoding == Encoding::Linear;
        // Of what is no code, one that stands for another number.
        let code = |x: f32| (x * 255.0 + 0.5) as u8;
        let is_code =
            |pixel: &Spectrum| pixel.to_array().iter().all(|&x| f32::from(code(x)) / 255.0 == x);
        let pixels = if !is_linear && image.pixels.iter().all(is_code) {
            let codes = |i: usize| {
                let [r, g, b] = image.pixels[i].to_array().map(code);
                [r, g, b, 0]
            };
            let meanings = std::array::from_fn(|code| curve.decoded(code as f64 / 255.0));
            Pixels::Codes(tiled(size, codes)?, Box::new(meanings))
        } else {
            let curve = if is_linear { Curve::Linear } else { curve };
            let value = |i: usize| image.pixels[i].to_array().map(|code| curve.decode(code));
            Pixels::Values(tiled(size, value)?)
        };
        Ok(Self::of(size, pixels))
    }

    fn of(size: UVec2, pixels: Pixels) -> Self {
        Self { size, tiles: size.x.div_ceil(4), pixels, smaller: OnceLock::new() }
    }

    /// The image at half its size, a quarter, and so on to a single pixel. Pixels are means over the area that they cover. Empty if they have not been
    /// [made](Self::make_smaller).
    pub(super) fn smaller(&self) -> &[Self] {
        self.smaller.get().map_or(&[], |all| all)
    }

    /// Makes the smaller images that filtering takes, once: together 16 bytes for each four pixels.
    ///
    /// # Errors
    /// If memory is not available.
    pub fn make_smaller(&self) -> Result<(), TexelsError> {
        if self.smaller.get().is_some() {
            return Ok(());
        }
        let mut all: Vec<Self> = Vec::new();
        loop {
            let last = all.last().unwrap_or(self);
            if last.size == UVec2::ONE {
                break;
            }
            all.push(last.halved()?);
        }
        // Another thread may have made the same.
        self.smaller.get_or_init(|| all);
        Ok(())
    }

    /// At half the size, rounded down but at least 1.
    fn halved(&self) -> Result<Self, TexelsError> {
        let size = (self.size / 2).max(UVec2::ONE);
        let (columns, rows) = (covered(self.size.x, size.x), covered(self.size.y, size.y));
        let value = |i: usize| {
            let (x, y) = (i % size.x as usize, i / size.x as usize);
            let mut sum = Spectrum::BLACK;
            for &(row, part_y) in &rows[y] {
                for &(column, part_x) in &columns[x] {
                    sum += self.at(column, row) * (part_x * part_y);
                }
            }
            sum.to_array()
        };
        Ok(Self::of(size, Pixels::Values(tiled(size, value)?)))
    }

    /// Columns and rows.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        let own = match &self.pixels {
            Pixels::Codes(codes, meanings) => size_of_val(&codes[..]) + size_of_val(&meanings[..]),
            Pixels::Values(values) => size_of_val(&values[..]),
        };
        own + self.smaller.get().map_or(0, |all| all.iter().map(Self::bytes).sum())
    }

    /// Between four pixels: of two columns and two rows, with the weights of the second of each.
    ///
    /// # Panics
    /// If there is no such pixel.
    #[inline]
    pub(super) fn between(&self, x: [u32; 2], y: [u32; 2], [part_x, part_y]: [f32; 2]) -> Spectrum {
        let row = |y| self.at(x[0], y) * (1.0 - part_x) + self.at(x[1], y) * part_x;
        row(y[0]) * (1.0 - part_y) + row(y[1]) * part_y
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
                codes.iter().for_each(|tile| add(&tile.0));
            }
            Pixels::Values(values) => {
                let values = values.iter().flat_map(|tile| tile.0);
                values.for_each(|value| add(&value.map(f32::to_le_bytes)));
            }
        }
        sum.finalize()
    }

    /// Reads a pixel, so that it is in the cache.
    #[inline]
    pub(super) fn touch(&self, x: u32, y: u32) -> u32 {
        let tile = (y / 4 * self.tiles + x / 4) as usize;
        match &self.pixels {
            Pixels::Codes(tiles, _) => tiles[tile].0[0][0].into(),
            Pixels::Values(tiles) => tiles[tile].0[0][0].to_bits(),
        }
    }

    /// The value of a pixel.
    ///
    /// # Panics
    /// If there is no such pixel.
    #[inline]
    pub fn at(&self, x: u32, y: u32) -> Spectrum {
        let tile = (y / 4 * self.tiles + x / 4) as usize;
        let within = (y % 4 * 4 + x % 4) as usize;
        match &self.pixels {
            Pixels::Codes(tiles, meanings) => {
                let [r, g, b, _] = tiles[tile].0[within].map(|code| meanings[usize::from(code)]);
                Spectrum::new(r, g, b)
            }
            Pixels::Values(tiles) => tiles[tile].0[within].into(),
        }
    }
}
