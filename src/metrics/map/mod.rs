//! [`ErrorMap`]: where two images differ, in colours, with a bar that tells what they mean.

mod digits;
mod scale;

use glam::UVec2;

use super::errors::check;
use super::{CompareError, Exposures, Viewing, flip};
use crate::image::{Image, encode_png};
use digits::{HEIGHT, draw, width};
use scale::{Scale, color};

/// One number for each pixel, to be shown in colours.
///
/// Dark is zero and light is much; of signed numbers blue is negative and red is positive. Both scales are even
/// in lightness, so that they stay the same without colours.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorMap {
    /// Columns and rows.
    pub size: UVec2,
    /// One for each pixel, row by row from the top left.
    pub values: Vec<f32>,
    /// Whether values may be negative.
    pub is_signed: bool,
    /// What the last colour stands for: all beyond it look alike.
    pub limit: f32,
}

impl ErrorMap {
    /// |a - b|, averaged over the bands of each pixel; the last colour is the value that one pixel in a thousand exceeds.
    ///
    /// # Errors
    /// As [`Errors::between`](super::Errors::between).
    pub fn absolute(image: &Image, reference: &Image) -> Result<Self, CompareError> {
        let values = differences(image, reference, f32::abs)?;
        Ok(Self::new(image.size, values, false))
    }

    /// a - b, averaged over the bands of each pixel; the last colours are the size that one pixel in a thousand exceeds.
    ///
    /// # Errors
    /// As [`Errors::between`](super::Errors::between).
    pub fn signed(image: &Image, reference: &Image) -> Result<Self, CompareError> {
        let values = differences(image, reference, |difference| difference)?;
        Ok(Self::new(image.size, values, true))
    }

    /// What [`flip`] sees, from 0 to 1, with the exposures that it saw it at.
    ///
    /// # Errors
    /// As [`Errors::between`](super::Errors::between).
    pub fn flip(
        image: &Image,
        reference: &Image,
        viewing: Viewing,
    ) -> Result<(Self, Option<Exposures>), CompareError> {
        let (values, exposures) = flip(image, reference, viewing)?;
        Ok((Self { size: image.size, values, is_signed: false, limit: 1.0 }, exposures))
    }

    fn new(size: UVec2, values: Vec<f32>, is_signed: bool) -> Self {
        let mut sizes: Vec<f32> = values.iter().map(|value| value.abs()).collect();
        let place = (sizes.len() - 1) * 999 / 1000;
        let (_, limit, _) = sizes.select_nth_unstable_by(place, f32::total_cmp);
        // Equal images, or differences in less than a thousandth of the pixels.
        let limit = if *limit > 0.0 { *limit } else { sizes.iter().copied().fold(0.0, f32::max) };
        let limit = if limit > 0.0 { limit } else { 1.0 };
        Self { size, values, is_signed, limit }
    }

    /// The mean of all values.
    pub fn mean(&self) -> f64 {
        self.values.iter().copied().map(f64::from).sum::<f64>() / self.values.len() as f64
    }

    /// The map in a screen's codes of three bands, row by row.
    pub fn codes(&self) -> Vec<u8> {
        let code = |&value: &f32| color(self.scale(), value / self.limit);
        self.values.iter().flat_map(code).collect()
    }

    /// The map as a PNG file, with a bar below it that says what its colours mean.
    pub fn png(&self) -> Vec<u8> {
        let UVec2 { x: width, y: height } = self.size.max(UVec2::new(BAR_WIDTH, 1));
        let size = UVec2::new(width, height + BAR_HEIGHT);
        let mut page = vec![255; 3 * (size.x * size.y) as usize];
        for (row, codes) in self.codes().chunks_exact(3 * self.size.x as usize).enumerate() {
            let start = 3 * row * width as usize;
            page[start..start + codes.len()].copy_from_slice(codes);
        }
        self.draw_bar(&mut page, size, height);
        // The page has as many codes as it has pixels.
        encode_png(size, &page).unwrap_or_default()
    }

    fn scale(&self) -> Scale {
        if self.is_signed { Scale::Diverging } else { Scale::Sequential }
    }

    /// Colours from end to end, with the values of both ends and of the middle.
    fn draw_bar(&self, page: &mut [u8], size: UVec2, top: u32) {
        let (left, length) = (MARGIN, size.x - 2 * MARGIN);
        let first = if self.is_signed { -1.0 } else { 0.0 };
        for x in 0..length {
            let value = first + (1.0 - first) * x as f32 / (length - 1) as f32;
            let code = color(self.scale(), value);
            for y in top + MARGIN..top + MARGIN + 12 {
                let at = 3 * (y * size.x + left + x) as usize;
                page[at..at + 3].copy_from_slice(&code);
            }
        }
        let y = top + MARGIN + 12 + 4;
        for (place, value) in [(0.0, first), (0.5, 0.5 * (1.0 + first)), (1.0, 1.0)] {
            let text = label(value * self.limit);
            let room = (length - width(&text)) as f32;
            draw(page, size, UVec2::new(left + (place * room).round() as u32, y), &text);
        }
    }
}

/// The bar's margins, and the least width that its labels have room in.
const MARGIN: u32 = 6;
const BAR_WIDTH: u32 = 184;
const BAR_HEIGHT: u32 = MARGIN + 12 + 4 + HEIGHT + MARGIN;

/// A value in two digits.
fn label(value: f32) -> String {
    match value.abs() {
        0.0 => "0".into(),
        0.01..100.0 => {
            let digits = (1.0 - value.abs().log10().floor()).max(0.0) as usize;
            format!("{value:.digits$}")
        }
        _ => format!("{value:.1e}"),
    }
}

fn differences(
    image: &Image,
    reference: &Image,
    of: fn(f32) -> f32,
) -> Result<Vec<f32>, CompareError> {
    check(image, reference)?;
    let both = image.pixels.iter().zip(&reference.pixels);
    let mean = |bands: [f32; 3]| bands.into_iter().map(of).sum::<f32>() / 3.0;
    Ok(both.map(|(&a, &b)| mean((a - b).to_array())).collect())
}
