//! [`Reference`]: what pictures are measured against, and how far it can be trusted.

use glam::{DVec3, UVec2};

use super::RunningMean;
use crate::image::{Encoding, Image};

/// A picture from independent parts, with its own error.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    image: Image,
    floor: f64,
    distrust: Option<Distrust>,
}

/// Why a reference should not be trusted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Distrust {
    /// Its error has not spread over the picture: some pixels have rare bright samples, of which more may be missing.
    #[error(
        "the reference has not converged: {:.0} % of its squared error lie in one pixel in a thousand, the worst at ({}, {}): more of it may be unseen",
        100.0 * .share, .worst.x, .worst.y
    )]
    Rare {
        /// The share of the squared error that the worst thousandth of the pixels has.
        share: f64,
        /// Column and row of the worst one.
        worst: UVec2,
    },
}

impl Reference {
    /// From at least two parts, of which each pixel is finite.
    pub fn new(pool: &RunningMean, size: UVec2) -> Self {
        let (pixels, variance) = pool.pixels();
        let image = Image { size, pixels, variance, encoding: Encoding::Linear };
        let mut squares: Vec<f64> = pool
            .moments()
            .map(|(mean, variance)| (variance / weights(mean)).element_sum() / 3.0)
            .collect();
        let total: f64 = squares.iter().sum();
        let floor = (total / squares.len() as f64).sqrt();
        let worst = (0..squares.len()).max_by(|&a, &b| squares[a].total_cmp(&squares[b]));
        squares.sort_unstable_by(|a, b| b.total_cmp(a));
        let few = squares.len().div_ceil(1000);
        let share = squares[..few].iter().sum::<f64>() / total;
        let place = worst.unwrap_or(0) as u32;
        let worst = UVec2::new(place % size.x, place / size.x);
        let distrust = (share > RARE).then_some(Distrust::Rare { share, worst });
        Self { image, floor, distrust }
    }

    /// The picture, with the variance of each pixel.
    pub fn image(&self) -> &Image {
        &self.image
    }

    /// Its own error, as the root of relMSE: below it nothing can be said of others.
    pub fn floor(&self) -> f64 {
        self.floor
    }

    /// Why not to trust it, if there is a reason.
    pub fn distrust(&self) -> Option<&Distrust> {
        self.distrust.as_ref()
    }

    /// A measured relMSE without the reference's own part, as a root; `None` where that would be
    /// less than the reference's own error.
    pub fn claimed(&self, rel_mse: f64) -> Option<f64> {
        let error = (rel_mse - self.floor * self.floor).max(0.0).sqrt();
        (error > self.floor).then_some(error)
    }
}

/// One pixel in a thousand has this share of the squared error where rare bright samples make up the picture. Of parts
/// that scatter alike everywhere it has about a hundredth.
const RARE: f64 = 0.5;

/// What squared differences are divided by.
pub(super) fn weights(reference: DVec3) -> DVec3 {
    reference * reference + 0.01
}
