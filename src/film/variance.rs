//! [`Variance`]: how the variance of pixels is estimated.

use std::io::{self, Write};

use super::pixel_sum::{PixelSum, zeroed};
use super::planes::Kind;
use super::stored::{read_all, write_all};
use crate::image::Plane;

/// How a film estimates the variance of each pixel's mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Variance {
    /// No estimate.
    #[default]
    None,
    /// From the differences between samples, which have to be independent of each other.
    OfSamples,
    /// From the differences between the means of this many sets of samples. The sets have to be independent of each
    /// other, the samples in a set may be correlated. One set or none gives no estimate.
    OfSets(u32),
}

impl Variance {
    /// The estimator for samples in this many sets, which are correlated within their set or not: see
    /// [`Sampler::is_correlated`](crate::sampling::Sampler::is_correlated).
    pub const fn suiting(is_correlated: bool, sets: u32) -> Self {
        match (is_correlated, sets) {
            (false, _) => Self::OfSamples,
            (true, 0 | 1) => Self::None,
            (true, sets) => Self::OfSets(sets),
        }
    }

    /// Bytes of [`VarianceSums`] for each pixel.
    pub(super) fn bytes(self) -> u64 {
        match self {
            Self::None | Self::OfSets(0 | 1) => 0,
            Self::OfSamples => size_of::<[f64; 3]>() as u64,
            Self::OfSets(sets) => u64::from(sets) * size_of::<PixelSum>() as u64,
        }
    }
}

/// The sums behind the estimates, for all pixels of a film.
#[derive(Clone, Debug)]
pub(super) enum VarianceSums {
    None,
    /// For each pixel, the sum of squared differences from its mean.
    Samples(Vec<[f64; 3]>),
    /// This many sums for each pixel, one after the other.
    Sets(usize, Vec<PixelSum>),
}

impl VarianceSums {
    /// Sums for `pixels` pixels, or `None` if there is not enough memory.
    pub fn new(variance: Variance, pixels: usize) -> Option<Self> {
        Some(match variance {
            Variance::None | Variance::OfSets(0 | 1) => Self::None,
            Variance::OfSamples => Self::Samples(zeroed(pixels)?),
            Variance::OfSets(sets) => {
                let sets = sets as usize;
                Self::Sets(sets, zeroed(pixels.checked_mul(sets)?)?)
            }
        })
    }

    /// Removes all samples and resizes to `pixels` pixels.
    pub fn reset(&mut self, pixels: usize) {
        match self {
            Self::None => {}
            Self::Samples(squares) => {
                squares.clear();
                squares.resize(pixels, [0.0; 3]);
            }
            Self::Sets(sets, sums) => {
                sums.clear();
                sums.resize(pixels * *sets, PixelSum::default());
            }
        }
    }

    /// What planes hold.
    pub fn kind(planes: &[Plane]) -> Variance {
        let words_of_sum = Kind::Sum.words(planes).max(1);
        match Kind::Sets.words(planes) / words_of_sum {
            0 if Kind::Squares.words(planes) > 0 => Variance::OfSamples,
            0 => Variance::None,
            sets => Variance::OfSets(sets as u32),
        }
    }

    /// Numbers of samples in sets.
    pub fn counts(&self) -> impl Iterator<Item = u32> {
        let sums = if let Self::Sets(_, sums) = self { &sums[..] } else { &[] };
        sums.iter().map(|sum| sum.samples)
    }

    /// Appends all sums of `pixels` pixels.
    pub fn push_planes(&self, pixels: usize, to: &mut Vec<Plane>) {
        match self {
            Self::None => {}
            Self::Samples(squares) => Kind::Squares.push(squares, pixels, to),
            Self::Sets(_, sums) => Kind::Sets.push(sums, pixels, to),
        }
    }

    /// Restores the sums of `pixels` pixels; `None` if planes are missing.
    pub fn restore_planes(&mut self, pixels: usize, from: &[Plane]) -> Option<()> {
        match self {
            Self::None => Some(()),
            Self::Samples(squares) => Kind::Squares.restore(squares, pixels, from),
            Self::Sets(_, sums) => Kind::Sets.restore(sums, pixels, from),
        }
    }

    /// Writes all sums.
    pub fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::None => Ok(()),
            Self::Samples(squares) => write_all(squares, to),
            Self::Sets(_, sums) => write_all(sums, to),
        }
    }

    /// Reads as many sums as there are; `None` if there are too few bytes.
    pub fn read(&mut self, from: &mut &[u8]) -> Option<()> {
        match self {
            Self::None => Some(()),
            Self::Samples(squares) => read_all(squares, from),
            Self::Sets(_, sums) => read_all(sums, from),
        }
    }

    /// Adds samples of `set` to the pixel at `index`, and to `all`, the sum of the pixel's samples.
    #[inline]
    pub fn add(
        &mut self,
        index: usize,
        set: u32,
        radiance: impl Iterator<Item = [f32; 3]>,
        all: &mut PixelSum,
    ) {
        // Copies of the sums stay in registers.
        let mut sum = *all;
        match self {
            Self::None => radiance.for_each(|radiance| sum.add(radiance)),
            Self::Samples(squares) => {
                let mut of_pixel = squares[index];
                for radiance in radiance {
                    sum.add(radiance);
                    // Youngs and Cramer 1971, "Some results relevant to choice of sum and sum-of-product
                    // algorithms": no cancellation, and exactly 0 as long as all samples are equal.
                    let n = f64::from(sum.samples);
                    let weight = 1.0 / (n * (n - 1.0)).max(1.0);
                    for ((square, x), sum) in of_pixel.iter_mut().zip(radiance).zip(sum.values) {
                        let difference = n * f64::from(x) - sum;
                        *square += weight * difference * difference;
                    }
                }
                squares[index] = of_pixel;
            }
            Self::Sets(sets, sums) => {
                debug_assert!((set as usize) < *sets, "set {set} of {sets}");
                let place = index * *sets + set as usize;
                let mut of_set = sums[place];
                for radiance in radiance {
                    sum.add(radiance);
                    of_set.add(radiance);
                }
                sums[place] = of_set;
            }
        }
        *all = sum;
    }

    /// Adds the pixel at `from` of another film to the pixel at `index`; `a` and `b` are the sums of the samples of this
    /// pixel and of the other one.
    pub fn merge(&mut self, index: usize, a: &PixelSum, other: &Self, from: usize, b: &PixelSum) {
        match (self, other) {
            (Self::Samples(squares), Self::Samples(others)) => {
                // Chan, Golub and LeVeque 1983, "Algorithms for computing the sample variance".
                let (na, nb) = (f64::from(a.samples), f64::from(b.samples));
                let weight = na * nb / (na + nb).max(1.0);
                let (mean_a, mean_b) = (a.mean(), b.mean());
                for band in 0..3 {
                    let difference = mean_b[band] - mean_a[band];
                    squares[index][band] += others[from][band] + weight * difference * difference;
                }
            }
            (Self::Sets(sets, sums), Self::Sets(_, others)) => {
                for set in 0..*sets {
                    sums[index * *sets + set].merge(&others[from * *sets + set]);
                }
            }
            _ => {}
        }
    }

    /// The degrees of freedom of [`of_mean`](Self::of_mean): samples less one, or sets with samples less one; 0 if there
    /// is no estimate.
    pub fn degrees_of_freedom(&self, index: usize, all: &PixelSum) -> u32 {
        match self {
            Self::None => 0,
            Self::Samples(_) => all.samples.saturating_sub(1),
            Self::Sets(sets, sums) => {
                let filled = sums[index * sets..][..*sets].iter().filter(|sum| sum.samples > 0);
                (filled.count() as u32).saturating_sub(1)
            }
        }
    }

    /// The variance of the mean of the pixel at `index`, whose samples have the sum `all`; `None` for fewer than two
    /// samples, or fewer than two sets with samples.
    pub fn of_mean(&self, index: usize, all: &PixelSum) -> Option<[f64; 3]> {
        let n = f64::from(all.samples);
        match self {
            Self::None => None,
            Self::Samples(squares) => {
                (all.samples > 1).then(|| squares[index].map(|s| s / (n - 1.0) / n))
            }
            Self::Sets(sets, sums) => {
                let sums = &sums[index * sets..][..*sets];
                let filled = sums.iter().filter(|sum| sum.samples > 0).count();
                if filled < 2 {
                    return None;
                }
                // Weighted by the sets' sizes, which is unbiased if a set's variance is inversely proportional to its size.
                let (mean, mut total) = (all.mean(), [0.0; 3]);
                for set in sums {
                    let (weight, of_set) = (f64::from(set.samples) / n, set.mean());
                    for band in 0..3 {
                        if set.samples > 0 {
                            total[band] += weight * (of_set[band] - mean[band]).powi(2);
                        }
                    }
                }
                Some(total.map(|total| total / (filled - 1) as f64))
            }
        }
    }
}
