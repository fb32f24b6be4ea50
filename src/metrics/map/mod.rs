//! [`ErrorMap`]: the difference of two images in false colours, with a legend.

mod digits;
mod scale;

use glam::UVec2;

use super::errors::check;
use super::{CompareError, Exposures, Viewing, flip};
use crate::image::{Image, encode_png};
use digits::{HEIGHT, draw, width};
use scale::{Scale, color};

/// One number for each pixel, shown in false colours.
///
/// Unsigned values go from dark at zero to light; signed ones from blue for negative over nearly white to red for
/// positive. Lightness changes linearly in both scales, so that they can be read in grey, too.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorMap {
    /// Columns and rows.
    pub size: UVec2,
    /// One value for each pixel, row by row from the top left.
    pub values: Vec<f32>,
    /// Whether values may be negative.
    pub is_signed: bool,
    /// The value of the scale's last colour; larger values get the same colour.
    pub limit: f32,
}

impl ErrorMap {
    /// |a - b|, averaged over the bands of each pixel. The scale ends at the 99.9th percentile.
    ///
    /// # Errors
    /// As [`Errors::between`](super::Errors::between).
    pub fn absolute(image: &Image, reference: &Image) -> Result<Self, CompareError> {
        let values = differences(image, reference, f32::abs)?;
        Ok(Self::new(image.size, values, false))
    }

    /// a - b, averaged over the bands of each pixel. The scale ends at the 99.9th percentile of the absolute value.
    ///
    /// # Errors
    /// As [`Errors::between`](super::Errors::between).
    pub fn signed(image: &Image, reference: &Image) -> Result<Self, CompareError> {
        let values = differences(image, reference, |difference| difference)?;
        Ok(Self::new(image.size, values, true))
    }

    /// The result of [`flip`], from 0 to 1, and the exposures that it used.
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
        let index = (sizes.len() - 1) * 999 / 1000;
        let (_, limit, _) = sizes.select_nth_unstable_by(index, f32::total_cmp);
        // Images that are equal, or differ in less than a thousandth of the pixels.
        let limit = if *limit > 0.0 { *limit } else { sizes.iter().copied().fold(0.0, f32::max) };
        let limit = if limit > 0.0 { limit } else { 1.0 };
        Self { size, values, is_signed, limit }
    }

    /// The mean of all values.
    pub fn mean(&self) -> f64 {
        self.values.iter().copied().map(f64::from).sum::<f64>() / self.values.len() as f64
    }

    /// The false colours as 8-bit sRGB codes: red, green, blue, red, ..., row by row.
    pub fn codes(&self) -> Vec<u8> {
        let code = |&value: &f32| color(self.scale(), value / self.limit);
        self.values.iter().flat_map(code).collect()
    }

    /// The map as a PNG file, with a legend below it.
    pub fn png(&self) -> Vec<u8> {
        let UVec2 { x: width, y: height } = self.size.max(UVec2::new(BAR_WIDTH, 1));
        let size = UVec2::new(width, height + BAR_HEIGHT);
        let mut page = vec![255; 3 * size.x as usize * size.y as usize];
        for (row, codes) in self.codes().chunks_exact(3 * self.size.x as usize).enumerate() {
            let start = 3 * row * width as usize;
            page[start..start + codes.len()].copy_from_slice(codes);
        }
        self.draw_bar(&mut page, size, height);
        // Cannot fail: the page has three codes for each pixel.
        encode_png(size, &page).unwrap_or_default()
    }

    fn scale(&self) -> Scale {
        if self.is_signed { Scale::Diverging } else { Scale::Sequential }
    }

    /// The legend: all colours of the scale, and the values at its ends and its middle.
    fn draw_bar(&self, page: &mut [u8], size: UVec2, top: u32) {
        let (left, length) = (MARGIN, size.x - 2 * MARGIN);
        let first = if self.is_signed { -1.0 } else { 0.0 };
        for x in 0..length {
            let value = first + (1.0 - first) * x as f32 / (length - 1) as f32;
            let code = color(self.scale(), value);
            for y in top + MARGIN..top + MARGIN + 12 {
                let at = 3 * (y as usize * size.x as usize + (left + x) as usize);
                page[at..at + 3].copy_from_slice(&code);
            }
        }
        let y = top + MARGIN + 12 + 4;
        for (position, value) in [(0.0, first), (0.5, 0.5 * (1.0 + first)), (1.0, 1.0)] {
            let text = label(value * self.limit);
            let room = (length - width(&text)) as f32;
            draw(page, size, UVec2::new(left + (position * room).round() as u32, y), &text);
        }
    }
}

/// The legend's margins, and the smallest width in which its labels fit.
const MARGIN: u32 = 6;
const BAR_WIDTH: u32 = 184;
const BAR_HEIGHT: u32 = MARGIN + 12 + 4 + HEIGHT + MARGIN;

/// A value with two significant digits.
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
