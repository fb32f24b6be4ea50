//! Chi-square and Z tests: the statistics of the check, for tests of other samplers as well.

/// The significance of each of `runs` tests such that all of them together are at 0.01 (Šidák).
pub fn significance(runs: u32) -> f64 {
    1.0 - 0.99_f64.powf(1.0 / f64::from(runs))
}

/// The probability of counts that fit their expectations as badly or worse, by Pearson's test. Cells that expect fewer than 5 are pooled.
pub fn chi_square(cells: impl Iterator<Item = (u64, f64)>) -> f64 {
    let (mut statistic, mut freedom) = (0.0, -1.0);
    let mut add = |observed: f64, expected: f64| {
        statistic += (observed - expected).powi(2) / expected;
        freedom += 1.0;
    };
    let (mut rest, mut rest_expected) = (0.0, 0.0);
    for (observed, expected) in cells {
        if expected >= 5.0 {
            add(observed as f64, expected);
        } else {
            rest += observed as f64;
            rest_expected += expected;
        }
    }
    if rest_expected >= 5.0 {
        add(rest, rest_expected);
    } else if rest > rest_expected + 20.0 {
        // Counts where next to nothing is expected.
        return 0.0;
    }
    if freedom < 1.0 { 1.0 } else { gamma_q(freedom / 2.0, statistic / 2.0) }
}

/// The probability that a mean is as far from the truth as `z` standard errors, or farther.
pub fn two_sided(z: f64) -> f64 {
    gamma_q(0.5, z * z / 2.0)
}

/// The regularised upper incomplete gamma function Q(a, x): series below a + 1, continued fraction above (Press et al., *Numerical Recipes*, 3rd
/// edition, section 6.2).
fn gamma_q(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 1.0;
    }
    let scale = (a * x.ln() - x - ln_gamma(a)).exp();
    if x < a + 1.0 {
        let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
        while term > sum * 1e-16 {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        return (1.0 - sum * scale).max(0.0);
    }
    // Lentz's method.
    let mut b = x + 1.0 - a;
    let (mut c, mut d) = (1e300, 1.0 / b);
    let mut fraction = d;
    for i in 1..10_000 {
        let numerator = -f64::from(i) * (f64::from(i) - a);
        b += 2.0;
        d = 1.0 / (numerator * d + b);
        c = b + numerator / c;
        fraction *= c * d;
        if (c * d - 1.0).abs() < 1e-15 {
            break;
        }
    }
    fraction * scale
}

/// ln Γ(x) for x > 0, by Stirling's series from x = 10 on.
fn ln_gamma(x: f64) -> f64 {
    let (mut shift, mut x) = (0.0, x);
    while x < 10.0 {
        shift -= x.ln();
        x += 1.0;
    }
    let series = 1.0 / (12.0 * x) - 1.0 / (360.0 * x.powi(3)) + 1.0 / (1260.0 * x.powi(5));
    shift + (x - 0.5) * x.ln() - x + 0.5 * std::f64::consts::TAU.ln() + series
}

/// Whether two numbers agree to a fraction, or both are as good as 0.
pub(super) fn is_close(a: f32, b: f32, tolerance: f32) -> bool {
    (a - b).abs() <= tolerance * a.abs().max(b.abs()) + 1e-6
}

/// Mean and standard error of numbers that come one by one (Welford's update).
#[derive(Clone, Copy, Debug, Default)]
pub struct Mean {
    count: f64,
    /// The mean so far; 0 without numbers.
    pub mean: f64,
    squares: f64,
}

impl Mean {
    /// Adds a number.
    pub fn add(&mut self, x: f64) {
        self.count += 1.0;
        let delta = x - self.mean;
        self.mean += delta / self.count;
        self.squares += delta * (x - self.mean);
    }

    /// The standard error of the mean; not a number for fewer than two.
    pub fn standard_error(&self) -> f64 {
        (self.squares / (self.count - 1.0) / self.count).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abramowitz and Stegun, table 26.8, and the normal distribution.
    #[test]
    fn tail_probabilities_are_those_of_the_tables() {
        for (freedom, chi2, p) in
            [(1.0, 3.84146, 0.05), (10.0, 23.2093, 0.01), (100.0, 118.498, 0.1)]
        {
            assert!((gamma_q(freedom / 2.0, chi2 / 2.0) - p).abs() < 1e-5 * (1.0 + p));
        }
        assert!((two_sided(1.959_964) - 0.05).abs() < 1e-6);
    }
}
