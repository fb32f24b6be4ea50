//! [`Discrete`]: one of many, by weight.

use crate::geometry::float::ONE_MINUS_EPSILON;

/// A choice among numbered things, each with a probability in proportion to its weight.
///
/// The sums of the weights are searched within one of as many equal buckets as there are weights
/// (Chen and Asau 1974, "On Generating Random Variates from an Empirical Distribution"), so that a choice
/// takes O(1) on average, and neighbouring random numbers choose neighbours: strata stay strata.
///
/// A random number has 24 bits. What is chosen with a probability below 2⁻²⁴ may never be, and what is left
/// of the number after a choice among n has log₂ n bits less.
///
/// ```
/// use lobe::sampling::Discrete;
/// let coin = Discrete::new([1.0, 0.0, 3.0]).unwrap();
/// assert_eq!(coin.sample(0.125), (0, 0.25, 0.5));
/// assert_eq!(coin.sample(0.625), (2, 0.75, 0.5));
/// assert_eq!(coin.probability(1), 0.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Discrete {
    /// Where the share of each begins in `[0, 1]`, and 1.
    starts: Box<[f64]>,
    /// How many shares end before each bucket.
    ended: Box<[u32]>,
}

impl Discrete {
    /// A choice by these weights. A weight below zero or NaN counts as zero. `None` when nothing has a
    /// weight, or the sum is infinite.
    ///
    /// # Panics
    /// If there are 2³² weights or more.
    pub fn new(weights: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sum = 0.0;
        let mut starts = vec![0.0];
        starts.extend(weights.into_iter().map(|weight| {
            sum += weight.max(0.0);
            sum
        }));
        if !(sum > 0.0 && sum < f64::INFINITY) {
            return None;
        }
        starts.iter_mut().for_each(|start| *start /= sum);
        let count = u32::try_from(starts.len() - 1).expect("fewer than 2^32 weights");
        let mut end = 0;
        let ended = (0..=count)
            .map(|first| {
                while bucket(starts[end as usize + 1], count as usize) < first as usize {
                    end += 1;
                }
                end
            })
            .collect();
        Some(Self { starts: starts.into(), ended })
    }

    /// What u in `[0, 1)` chooses, its probability, above 0, and u's place within its share, which is
    /// again uniform in `[0, 1)`.
    #[inline]
    pub fn sample(&self, u: f32) -> (usize, f32, f32) {
        let u = f64::from(u);
        let bucket = bucket(u, self.ended.len() - 1);
        let (from, to) = (self.ended[bucket] as usize, self.ended[bucket + 1] as usize);
        // Those before end in an earlier bucket, at or below u; the one after ends in a later one.
        let index = from + self.starts[from + 1..=to].partition_point(|&end| end <= u);
        let (start, end) = (self.starts[index], self.starts[index + 1]);
        let rest = ((u - start) / (end - start)) as f32;
        (index, (end - start) as f32, rest.min(ONE_MINUS_EPSILON))
    }

    /// The probability of one of them.
    ///
    /// # Panics
    /// If there is none with this index.
    #[inline]
    pub fn probability(&self, index: usize) -> f32 {
        (self.starts[index + 1] - self.starts[index]) as f32
    }
}

/// Which of `count` equal parts of `[0, 1]` holds `u`; `count` for 1. It never falls as u grows, whatever
/// is rounded.
#[inline]
fn bucket(u: f64, count: usize) -> usize {
    (u * count as f64) as usize
}
