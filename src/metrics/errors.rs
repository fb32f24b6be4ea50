//! [`Errors`]: MSE, MAE, relMSE and PSNR of two images.

use std::ops::{Add, Mul};

use glam::UVec2;

use crate::image::{Encoding, Image};
use crate::spectrum::Spectrum;

/// Differences between an image a and a reference b, averaged over all bands of all pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Mean of (a - b)².
    pub mse: f64,
    /// Mean of |a - b|.
    pub mae: f64,
    /// Mean of (a - b)² / (b² + 0.01).
    pub rel_mse: f64,
    /// Peak value for [`Errors::psnr`]: 1 for codes; for radiance the largest value of the reference.
    pub peak: f64,
    /// Mean of a - b, in which noise averages out: a bias of the whole image.
    pub mean: f64,
}

/// Why two images cannot be compared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// The images have different sizes.
    #[error("the images have {} x {} and {} x {} pixels: they have to be of one size", .0.x, .0.y, .1.x, .1.y)]
    Size(UVec2, UVec2),
    /// One image is linear, the other one encoded.
    #[error(
        "one image is linear (EXR, PFM), the other one encoded for a screen (PNG): compare two of one kind"
    )]
    Encoding,
    /// There is not enough memory.
    #[error("comparing {} x {} pixels takes {} MiB of memory, which are not available", .0.x, .0.y, .1)]
    OutOfMemory(UVec2, u64),
    /// One image has values that are not finite.
    #[error("{count} pixels of the {which} are not finite, at {}: no mean over them would mean anything", positions(.first, *.count))]
    NotFinite {
        /// "image" or "reference".
        which: &'static str,
        /// Number of such pixels.
        count: usize,
        /// Columns and rows of the first few.
        first: Vec<UVec2>,
    },
}

fn positions(first: &[UVec2], count: usize) -> String {
    let more = if count > first.len() { ", ..." } else { "" };
    let list = first.iter().map(|at| format!("({}, {})", at.x, at.y)).collect::<Vec<_>>();
    list.join(", ") + more
}

/// At most this many pixels that are not finite are named.
const NAMED: usize = 5;

impl Errors {
    /// The errors of `image` against `reference`.
    ///
    /// # Errors
    /// When the images differ in size or encoding, or have values that are not finite.
    pub fn between(image: &Image, reference: &Image) -> Result<Self, CompareError> {
        check(image, reference)?;
        let bands = |image: &Image| {
            let bands = |pixel: &Spectrum| pixel.to_array().map(f64::from);
            image.pixels.iter().flat_map(bands).collect::<Vec<f64>>()
        };
        let (a, b) = (bands(image), bands(reference));
        let mean = |term: fn(f64, f64) -> f64| {
            a.iter().zip(&b).map(|(&a, &b)| term(a, b)).sum::<f64>() / a.len() as f64
        };
        let peak = match reference.encoding {
            Encoding::Linear => b.iter().copied().fold(0.0, f64::max),
            Encoding::Srgb => 1.0,
        };
        Ok(Self {
            mse: mean(|a, b| (a - b).powi(2)),
            mae: mean(|a, b| (a - b).abs()),
            rel_mse: mean(|a, b| (a - b).powi(2) / rel_mse_denominator(b)),
            mean: mean(|a, b| a - b),
            peak,
        })
    }

    /// √MSE.
    pub fn rmse(&self) -> f64 {
        self.mse.sqrt()
    }

    /// 10 log₁₀(peak² / MSE) in dB; infinite for equal images.
    pub fn psnr(&self) -> f64 {
        // Otherwise 0 / 0 for images that are black.
        if self.mse == 0.0 {
            return f64::INFINITY;
        }
        10.0 * (self.peak * self.peak / self.mse).log10()
    }
}

/// The denominator of relMSE for a value of the reference, or for several values at a time.
pub(super) fn rel_mse_denominator<T>(reference: T) -> T
where
    T: Copy + Mul<Output = T> + Add<f64, Output = T>,
{
    reference * reference + 0.01
}

/// Column and row of a pixel. Its index may leave 32 bits.
pub(super) fn place(index: usize, size: UVec2) -> UVec2 {
    let width = size.x as usize;
    UVec2::new((index % width) as u32, (index / width) as u32)
}

/// Bytes for each pixel that any of the comparisons takes, FLIP the most.
const MEMORY: u64 = 256;

/// Checks that the images can be compared.
pub(super) fn check(image: &Image, reference: &Image) -> Result<(), CompareError> {
    if image.size != reference.size {
        return Err(CompareError::Size(image.size, reference.size));
    }
    if image.encoding != reference.encoding {
        return Err(CompareError::Encoding);
    }
    let bytes = MEMORY * image.pixels.len() as u64;
    let is_available =
        usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok());
    if !is_available {
        return Err(CompareError::OutOfMemory(image.size, bytes.div_ceil(1 << 20)));
    }
    for (which, image) in [("image", image), ("reference", reference)] {
        let is_odd = |index: &usize| !image.pixels[*index].is_finite();
        let odd: Vec<usize> = (0..image.pixels.len()).filter(is_odd).collect();
        if !odd.is_empty() {
            let first = odd.iter().take(NAMED).map(|&index| place(index, image.size)).collect();
            return Err(CompareError::NotFinite { which, count: odd.len(), first });
        }
    }
    Ok(())
}
