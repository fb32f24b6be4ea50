//! [`Reference`]: the picture that others are compared with, and its own error.

use glam::UVec2;

use super::super::errors::rel_mse_denominator;
use super::RunningMean;
use crate::image::{Encoding, Image};

/// The mean of independent pictures, with an estimate of its own error.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    image: Image,
    floor: f64,
    distrust: Option<Distrust>,
}

/// Why a reference should not be trusted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Distrust {
    /// Most of the squared error is in a few pixels. Those have rare bright samples, and more of them may be missing.
    #[error(
        "the reference has not converged: {:.0} % of its squared error are in one pixel of a thousand, the worst at ({}, {}): rare bright samples may be missing",
        100.0 * .share, .worst.x, .worst.y
    )]
    Rare {
        /// Share of the squared error in the worst thousandth of the pixels.
        share: f64,
        /// Column and row of the worst pixel.
        worst: UVec2,
    },
}

impl Reference {
    /// A reference from the mean of at least two pictures, in which all values are finite.
    pub fn new(parts: &RunningMean, size: UVec2) -> Self {
        let (pixels, variance) = parts.pixels();
        let degrees_of_freedom = parts.degrees_of_freedom();
        let image =
            Image { size, pixels, variance, degrees_of_freedom, encoding: Encoding::Linear };
        let mut squares: Vec<f64> = parts
            .moments()
            .map(|(mean, variance)| (variance / rel_mse_denominator(mean)).element_sum() / 3.0)
            .collect();
        let total: f64 = squares.iter().sum();
        let floor = (total / squares.len() as f64).sqrt();
        let worst = (0..squares.len()).max_by(|&a, &b| squares[a].total_cmp(&squares[b]));
        squares.sort_unstable_by(|a, b| b.total_cmp(a));
        let few = squares.len().div_ceil(1000);
        let share = squares[..few].iter().sum::<f64>() / total;
        let index = worst.unwrap_or(0) as u32;
        let worst = UVec2::new(index % size.x, index / size.x);
        let distrust = (share > RARE).then_some(Distrust::Rare { share, worst });
        Self { image, floor, distrust }
    }

    /// The mean, with the variance of each pixel.
    pub fn image(&self) -> &Image {
        &self.image
    }

    /// Its own error, as a root of relMSE. Errors below it are not claimed.
    pub fn floor(&self) -> f64 {
        self.floor
    }

    /// A reason not to trust it, if there is one.
    pub fn distrust(&self) -> Option<&Distrust> {
        self.distrust.as_ref()
    }

    /// The root of a measured relMSE with the reference's own part subtracted; `None` if the result is not above the
    /// reference's own error.
    pub fn claimed(&self, rel_mse: f64) -> Option<f64> {
        let error = self.subtracted_from(rel_mse);
        (error > self.floor).then_some(error)
    }

    /// The root of a measured relMSE with the reference's own part subtracted; 0 if the result is negative.
    pub(super) fn subtracted_from(&self, rel_mse: f64) -> f64 {
        (rel_mse - self.floor * self.floor).max(0.0).sqrt()
    }
}

/// Share of the squared error in the worst thousandth of the pixels from which on a reference is not trusted. It is about
/// 0.01 if the noise is alike everywhere.
const RARE: f64 = 0.5;
