//! [`Map`]: the radiance of an equirectangular image.

use std::f64::consts::PI;

use glam::{DVec2, DVec3, UVec2};

use super::error::EnvironmentError;
use super::orientation::Place;
use crate::image::Image;
use crate::spectrum::Spectrum;
use crate::texture::{Curve, Texels};

/// Radiance over the sphere: bilinear in longitude and latitude between the centres of pixels, around the image from the last
/// column to the first, and constant from the centres of the first and last row to the poles.
pub struct Map {
    texels: Texels,
    scale: Spectrum,
    /// What each band adds to the luminance, with its scale.
    luminance: DVec3,
    is_constant: bool,
}

/// A cell of the sphere, where the radiance is bilinear between four pixels, and a point in it.
///
/// Cell (i, j) lies between the centres of columns i and i + 1, and of rows j - 1 and j. So there are as many columns, and one
/// row more.
#[derive(Clone, Copy, Debug)]
pub struct CellPoint {
    pub cell: UVec2,
    /// From 0 at the centres of the left and upper pixels to 1 at those of the right and lower ones.
    pub within: DVec2,
}

/// Pixels around a cell: `[row][column]`.
pub type Corners = [[Spectrum; 2]; 2];

impl Map {
    /// Checks the pixels. Codes of PNG and JPEG are those of sRGB.
    pub fn new(image: &Image, scale: Spectrum) -> Result<Self, EnvironmentError> {
        let texels = Texels::new(image, Curve::Srgb)?;
        if !scale.is_valid() {
            return Err(EnvironmentError::Scale(scale));
        }
        let overflows = |value: &Spectrum| !(*value * scale).is_valid();
        if let Some(index) = image.pixels.iter().position(overflows) {
            let columns = image.size.x as usize;
            let at = UVec2::new((index % columns) as u32, (index / columns) as u32);
            return Err(EnvironmentError::Overflow { at, value: image.pixels[index], scale });
        }
        let is_constant = image.pixels.iter().all(|pixel| *pixel == image.pixels[0]);
        let bands = DVec3::from(scale.to_array().map(f64::from));
        let luminance = bands * DVec3::new(0.2126, 0.7152, 0.0722);
        Ok(Self { texels, scale, luminance, is_constant })
    }

    /// Whether all pixels are alike.
    pub fn is_constant(&self) -> bool {
        self.is_constant
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        self.texels.bytes()
    }

    /// Columns and rows of cells.
    pub fn cells(&self) -> UVec2 {
        self.texels.size() + UVec2::Y
    }

    /// The cell that holds a point of the image.
    #[inline]
    pub fn cell_point(&self, place: &Place) -> CellPoint {
        let size = self.texels.size();
        let columns = f64::from(size.x);
        let x = place.x * columns - 0.5;
        // Half a column at the left belongs to the last cell of a row.
        let x = if x < 0.0 { x + columns } else { x };
        let y = place.y * f64::from(size.y) + 0.5;
        let cell = UVec2::new((x as u32).min(size.x - 1), (y as u32).min(size.y));
        CellPoint { cell, within: DVec2::new(x, y) - cell.as_dvec2() }
    }

    /// The height z = cos θ of the upper edge of a row of cells, or of the lower edge of the last.
    pub fn edge(&self, row: u32) -> f64 {
        self.edge_angle(row).cos()
    }

    /// θ there.
    fn edge_angle(&self, row: u32) -> f64 {
        let rows = f64::from(self.texels.size().y);
        (PI * (f64::from(row) - 0.5) / rows).clamp(0.0, PI)
    }

    /// The pixels around a cell.
    #[inline]
    pub fn corners(&self, cell: UVec2) -> Corners {
        let size = self.texels.size();
        let right = if cell.x + 1 < size.x { cell.x + 1 } else { 0 };
        let rows = [cell.y.saturating_sub(1), cell.y.min(size.y - 1)];
        rows.map(|row| [cell.x, right].map(|column| self.texels.at(column, row)))
    }

    /// The radiance at a point of a cell with these corners.
    #[inline]
    pub fn radiance(&self, point: &CellPoint, corners: &Corners) -> Spectrum {
        let [s, t] = point.within.as_vec2().to_array();
        let [[a, b], [c, d]] = *corners;
        // Never below 0, and exact between equal pixels.
        let (upper, lower) = (a + (b - a) * s, c + (d - c) * s);
        (upper + (lower - upper) * t) * self.scale
    }

    /// The luminance of each corner. Above 0 where any band is, since f64 does not underflow.
    #[inline]
    pub fn luminances(&self, corners: &Corners) -> [[f64; 2]; 2] {
        let luminance =
            |pixel: Spectrum| DVec3::from(pixel.to_array().map(f64::from)).dot(self.luminance);
        corners.map(|row| row.map(luminance))
    }

    /// Mean over the sphere.
    pub fn mean(&self) -> Spectrum {
        let UVec2 { x: columns, y: rows } = self.texels.size();
        let mut sum = DVec3::ZERO;
        for row in 0..rows {
            let pixels = (0..columns).map(|column| self.texels.at(column, row).to_array());
            let of_row: DVec3 = pixels.map(|pixel| DVec3::from(pixel.map(f64::from))).sum();
            sum += of_row * (self.share(row)[1] + self.share(row + 1)[0]);
        }
        let mean = sum / (2.0 * f64::from(columns));
        Spectrum::from(mean.to_array().map(|band| band as f32)) * self.scale
    }

    /// What the upper and the lower pixels count in the mean over a row of cells, times its height: the integrals of
    /// (1 - t) sin θ and of t sin θ over θ, where t runs from 0 to 1.
    fn share(&self, row: u32) -> [f64; 2] {
        let [from, to] = [row, row + 1].map(|row| self.edge_angle(row));
        let all = from.cos() - to.cos();
        // Constant beyond the outermost centres.
        if row == 0 {
            return [0.0, all];
        }
        if row == self.texels.size().y {
            return [all, 0.0];
        }
        let lower = (to.sin() - from.sin()) / (to - from) - to.cos();
        [all - lower, lower]
    }
}
