//! [`Bias`]: what no number of samples takes away.

use glam::DVec3;

use super::reference::weights;
use super::{Reference, RunningMean};
use crate::spectrum::Spectrum;

/// How far the mean of a method's pictures is from the reference, beyond what noise explains.
///
/// In each pixel (mean - reference)² less both variances is the square of the bias, without bias of its own; the
/// average over pixels is compared with its standard error, which follows from how it scatters from tile to tile. But
/// rare bright samples that none of the pictures has would look like a bias: so the error is no less than it would be
/// if the pictures varied as much as the reference does, sample for sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bias {
    /// The bias as a root of relMSE: √(MSE - variance), 0 where the difference is negative.
    pub error: f64,
    /// The same squared, which may be negative, and its standard error.
    pub square: (f64, f64),
    /// Mean of method less reference in radiance, and its standard error.
    pub mean: (f64, f64),
}

impl Bias {
    /// So many standard errors are no chance.
    pub const LIMIT: f64 = 5.0;

    /// The bias of the method whose pictures the pool has, at least two of them; together they have `part` times as many
    /// samples as the reference.
    pub fn new(pool: &RunningMean, reference: &Reference, part: f64) -> Self {
        let image = reference.image();
        let known = image.variance.iter().flatten();
        let wide = |pixel: &Spectrum| DVec3::from(pixel.to_array().map(f64::from));
        let truth = image.pixels.iter().map(wide).zip(known.map(wide));
        let (columns, rows) = (image.size.x.div_ceil(TILE), image.size.y.div_ceil(TILE));
        let mut tiles = vec![(0.0, 0.0); (columns * rows) as usize];
        let (mut difference, mut spread, mut unseen) = (0.0, DVec3::ZERO, 0.0);
        for (place, ((mean, variance), (truth, own))) in (0_u32..).zip(pool.moments().zip(truth)) {
            let apart = mean - truth;
            let square = (apart * apart - variance - own) / weights(truth);
            let (x, y) = (place % image.size.x, place / image.size.x);
            let tile = &mut tiles[(y / TILE * columns + x / TILE) as usize];
            tile.0 += square.element_sum() / 3.0;
            tile.1 += 1.0;
            difference += apart.element_sum();
            let expected = variance.max(own / part);
            spread += expected + own;
            // The square of a normal variable varies by twice the square of its variance; bands go together.
            let of_square =
                (2.0_f64.sqrt() * (expected + own) / weights(truth)).element_sum() / 3.0;
            unseen += of_square * of_square;
        }
        let bands = 3.0 * image.pixels.len() as f64;
        let (square, scattered) = scatter(&tiles);
        let least = unseen.sqrt() / image.pixels.len() as f64;
        let square = (square, scattered.max(least));
        // Pixels are taken to be independent, the bands of one are not: their errors may add up.
        let error = spread.to_array().map(f64::sqrt).iter().sum::<f64>();
        let mean = (difference / bands, error / bands);
        Self { error: square.0.max(0.0).sqrt(), square, mean }
    }

    /// How large it is: the root of relMSE, or where noise in the pixels hides that, the difference of the means.
    pub fn size(&self) -> f64 {
        if self.error > 0.0 { self.error } else { self.mean.0.abs() }
    }

    /// Whether noise does not explain it.
    pub fn is_certain(&self) -> bool {
        let beyond = |(value, error): (f64, f64)| value > Self::LIMIT * error;
        beyond(self.square) || beyond((self.mean.0.abs(), self.mean.1))
    }
}

/// Columns and rows of a tile. Samplers may make neighbouring pixels depend on each other.
const TILE: u32 = 8;

/// The mean of values by sums and weights of tiles, and its standard error.
fn scatter(tiles: &[(f64, f64)]) -> (f64, f64) {
    let weight: f64 = tiles.iter().map(|(_, weight)| weight).sum();
    let mean = tiles.iter().map(|(sum, _)| sum).sum::<f64>() / weight;
    let square = |&(sum, weight): &(f64, f64)| (sum - weight * mean).powi(2);
    // Of a single tile nothing is known: NaN, to which the caller's least is preferred.
    let few = tiles.len() as f64 / (tiles.len() as f64 - 1.0);
    (mean, (few * tiles.iter().map(square).sum::<f64>()).sqrt() / weight)
}
