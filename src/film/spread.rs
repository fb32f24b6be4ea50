//! [`Variance`]: from what a film tells how far off its means are.

use super::sums::{Sum, zeroed};

/// From what a film tells the variance of a pixel's mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Variance {
    /// Not at all.
    #[default]
    None,
    /// From how far samples differ, which have to be independent of each other.
    OfSamples,
    /// From how far the means of this many sets of samples differ, which have to be independent of each
    /// other; one set, or none, tells nothing.
    OfSets(u32),
}

impl Variance {
    /// What suits samples that come in so many sets, and know of the others in their set if they are correlated:
    /// see [`Sampler::is_correlated`](crate::sampling::Sampler::is_correlated).
    pub const fn suiting(is_correlated: bool, sets: u32) -> Self {
        match (is_correlated, sets) {
            (false, _) => Self::OfSamples,
            (true, 0 | 1) => Self::None,
            (true, sets) => Self::OfSets(sets),
        }
    }

    /// How many bytes a film keeps for it in each pixel.
    pub(super) fn bytes(self) -> u64 {
        match self {
            Self::None | Self::OfSets(0 | 1) => 0,
            Self::OfSamples => size_of::<[f64; 3]>() as u64,
            Self::OfSets(sets) => u64::from(sets) * size_of::<Sum>() as u64,
        }
    }
}

/// What a film keeps for the variance.
#[derive(Clone, Debug)]
pub(super) enum Spread {
    None,
    /// Sums of squared differences from the pixel's mean.
    Samples(Vec<[f64; 3]>),
    /// So many sums for each pixel, one after the other.
    Sets(usize, Vec<Sum>),
}

impl Spread {
    /// Room for `pixels` pixels, or `None` if there is no memory for it.
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

    /// Forgets everything and stands for `pixels` pixels.
    pub fn reset(&mut self, pixels: usize) {
        match self {
            Self::None => {}
            Self::Samples(squares) => {
                squares.clear();
                squares.resize(pixels, [0.0; 3]);
            }
            Self::Sets(sets, sums) => {
                sums.clear();
                sums.resize(pixels * *sets, Sum::default());
            }
        }
    }

    /// Adds a sample of `set` to the pixel at `place`, of which `all` is the sum with the sample.
    #[inline]
    pub fn add(&mut self, place: usize, set: u32, radiance: [f32; 3], all: &Sum) {
        match self {
            Self::None => {}
            Self::Samples(squares) => {
                // Youngs and Cramer 1971, "Some results relevant to choice of sum and sum-of-product
                // algorithms": no difference of large numbers, and exactly 0 while all samples are equal.
                let n = f64::from(all.samples);
                let weight = 1.0 / (n * (n - 1.0)).max(1.0);
                for ((square, x), sum) in squares[place].iter_mut().zip(radiance).zip(all.values) {
                    let difference = n * f64::from(x) - sum;
                    *square += weight * difference * difference;
                }
            }
            Self::Sets(sets, sums) => {
                debug_assert!((set as usize) < *sets, "set {set} of {sets}");
                sums[place * *sets + set as usize].add(radiance);
            }
        }
    }

    /// Adds what `other` keeps for the pixel at `from` to the pixel at `place`, whose sums are `a` and,
    /// in the other film, `b`.
    pub fn merge(&mut self, place: usize, a: &Sum, other: &Self, from: usize, b: &Sum) {
        match (self, other) {
            (Self::Samples(squares), Self::Samples(others)) => {
                // Chan, Golub and LeVeque 1983, "Algorithms for computing the sample variance".
                let (na, nb) = (f64::from(a.samples), f64::from(b.samples));
                let weight = na * nb / (na + nb).max(1.0);
                let (mean_a, mean_b) = (a.mean(), b.mean());
                for band in 0..3 {
                    let difference = mean_b[band] - mean_a[band];
                    squares[place][band] += others[from][band] + weight * difference * difference;
                }
            }
            (Self::Sets(sets, sums), Self::Sets(_, others)) => {
                for set in 0..*sets {
                    sums[place * *sets + set].merge(&others[from * *sets + set]);
                }
            }
            _ => {}
        }
    }

    /// The variance of the mean of the pixel at `place`, whose sum is `all`; `None` if fewer than two
    /// samples, or sets with samples, are there to tell it from.
    pub fn variance(&self, place: usize, all: &Sum) -> Option<[f64; 3]> {
        let n = f64::from(all.samples);
        match self {
            Self::None => None,
            Self::Samples(squares) => {
                (all.samples > 1).then(|| squares[place].map(|s| s / (n - 1.0) / n))
            }
            Self::Sets(sets, sums) => {
                let sums = &sums[place * sets..][..*sets];
                let filled = sums.iter().filter(|sum| sum.samples > 0).count();
                if filled < 2 {
                    return None;
                }
                // Each set in proportion to its size: unbiased as far as a set's variance falls with it.
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
