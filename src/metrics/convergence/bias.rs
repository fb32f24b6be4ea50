//! [`Bias`]: the error that remains however many samples are taken.

use glam::DVec3;

use super::super::errors::rel_mse_denominator;
use super::{Reference, RunningMean};
use crate::spectrum::Spectrum;

/// Estimate of a method's bias: the difference between the mean of its pictures and the reference that noise does not
/// explain.
///
/// In each pixel (mean - reference)² minus both variances is an unbiased estimate of the squared bias. The standard error
/// of its average over the pixels is estimated from the scatter between tiles. Rare bright samples that none of the
/// pictures contains would look like a bias; so the standard error is at least what it would be if the pictures had the
/// variance per sample of the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bias {
    /// The bias as a root of relMSE: √(MSE - variance), or 0 if the difference is negative.
    pub error: f64,
    /// Its square before clamping, which may be negative, and the standard error of that.
    pub square: (f64, f64),
    /// Mean of (method - reference) in radiance, and its standard error.
    pub mean: (f64, f64),
}

impl Bias {
    /// More than this many standard errors are significant.
    pub const LIMIT: f64 = 5.0;

    /// Estimates the bias from the mean of at least two pictures. `part` is the number of samples in all of them over that
    /// in the reference.
    pub fn new(pictures: &RunningMean, reference: &Reference, part: f64) -> Self {
        let image = reference.image();
        let known = image.variance.iter().flatten();
        let wide = |pixel: &Spectrum| DVec3::from(pixel.to_array().map(f64::from));
        let truth = image.pixels.iter().map(wide).zip(known.map(wide));
        let (columns, rows) = (image.size.x.div_ceil(TILE), image.size.y.div_ceil(TILE));
        let mut tiles = vec![(0.0, 0.0); (columns * rows) as usize];
        let (mut difference, mut variances, mut unseen) = (0.0, DVec3::ZERO, 0.0);
        for (index, ((mean, variance), (truth, own))) in
            (0_u32..).zip(pictures.moments().zip(truth))
        {
            let apart = mean - truth;
            let square = (apart * apart - variance - own) / rel_mse_denominator(truth);
            let (x, y) = (index % image.size.x, index / image.size.x);
            let tile = &mut tiles[(y / TILE * columns + x / TILE) as usize];
            tile.0 += square.element_sum() / 3.0;
            tile.1 += 1.0;
            difference += apart.element_sum();
            let expected = variance.max(own / part);
            variances += expected + own;
            // A squared normal variable has twice the squared variance; bands are taken to be fully correlated.
            let of_square = (2.0_f64.sqrt() * (expected + own) / rel_mse_denominator(truth))
                .element_sum()
                / 3.0;
            unseen += of_square * of_square;
        }
        let bands = 3.0 * image.pixels.len() as f64;
        let (square, scattered) = scatter(&tiles);
        let least = unseen.sqrt() / image.pixels.len() as f64;
        let square = (square, scattered.max(least));
        // Pixels are taken to be independent, the bands of a pixel to be fully correlated.
        let error = variances.to_array().map(f64::sqrt).iter().sum::<f64>();
        let mean = (difference / bands, error / bands);
        Self { error: square.0.max(0.0).sqrt(), square, mean }
    }

    /// Its size: the root of relMSE, or the difference of the means if noise in the pixels hides that.
    pub fn size(&self) -> f64 {
        if self.error > 0.0 { self.error } else { self.mean.0.abs() }
    }

    /// Whether it is significant: more than [`LIMIT`](Self::LIMIT) standard errors.
    pub fn is_certain(&self) -> bool {
        let beyond = |(value, error): (f64, f64)| value > Self::LIMIT * error;
        beyond(self.square) || beyond((self.mean.0.abs(), self.mean.1))
    }
}

/// Columns and rows of a tile. Samplers may correlate neighbouring pixels.
const TILE: u32 = 8;

/// The mean over all tiles, given as (sum, number of pixels), and its standard error.
fn scatter(tiles: &[(f64, f64)]) -> (f64, f64) {
    let weight: f64 = tiles.iter().map(|(_, weight)| weight).sum();
    let mean = tiles.iter().map(|(sum, _)| sum).sum::<f64>() / weight;
    let square = |&(sum, weight): &(f64, f64)| (sum - weight * mean).powi(2);
    // NaN for a single tile; the caller's `max` then takes its lower bound.
    let few = tiles.len() as f64 / (tiles.len() as f64 - 1.0);
    (mean, (few * tiles.iter().map(square).sum::<f64>()).sqrt() / weight)
}
