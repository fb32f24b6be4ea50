//! [`Discrete`]: a discrete distribution over indices.

use crate::geometry::float::ONE_MINUS_EPSILON;

/// A discrete distribution: index i has a probability in proportion to its weight.
///
/// Sampling inverts the cumulative distribution. The search starts in one of as many equal buckets
/// as there are weights (Chen and Asau 1974, "On Generating Random Variates from an Empirical
/// Distribution"), so it takes O(1) on average. Unlike an alias table it is monotonic: stratified u
/// give stratified indices.
///
/// u has 24 bits of resolution. An index with a probability below 2⁻²⁴ may never be drawn, and the
/// remapped u after a choice among n has log₂ n bits less.
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
    /// The cumulative distribution: where the share of each index begins in `[0, 1]`, and a final
    /// 1.
    starts: Box<[f64]>,
    /// For each bucket, the number of shares that end in an earlier one.
    ended: Box<[u32]>,
}

impl Discrete {
    /// The distribution with these weights. A weight that is negative or NaN counts as zero. `None`
    /// if the sum of the weights is zero or infinite.
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

    /// The index that u in `[0, 1)` selects, its probability, above 0, and u remapped to its
    /// position within the index's share, which is again uniform in `[0, 1)`.
    #[inline]
    pub fn sample(&self, u: f32) -> (usize, f32, f32) {
        let u = f64::from(u);
        let bucket = bucket(u, self.ended.len() - 1);
        let (from, to) = (self.ended[bucket] as usize, self.ended[bucket + 1] as usize);
        // Binary search among the shares that end in this bucket. Shares before `from` end in an
        // earlier bucket, at or below u; share `to` ends in a later one, above u.
        let index = from + self.starts[from + 1..=to].partition_point(|&end| end <= u);
        let (start, end) = (self.starts[index], self.starts[index + 1]);
        let rest = ((u - start) / (end - start)) as f32;
        (index, (end - start) as f32, rest.min(ONE_MINUS_EPSILON))
    }

    /// The probability of `index`.
    ///
    /// # Panics
    /// If `index` is out of range.
    #[inline]
    pub fn probability(&self, index: usize) -> f32 {
        (self.starts[index + 1] - self.starts[index]) as f32
    }
}

/// The bucket that holds `u`, of `count` equal ones over `[0, 1]`; `count` for u = 1. Monotonic in
/// u in spite of rounding.
#[inline]
fn bucket(u: f64, count: usize) -> usize {
    (u * count as f64) as usize
}
