//! Statistics: chi-square and Z tests at a stated significance.
//!
//! All tests are held to a significance of 0.01 with the Šidák correction over all runs of one test:
//! a right program fails it for one seed in a hundred.

/// The significance of each of `runs` tests such that all of them together are at 0.01.
pub fn sidak(runs: usize) -> f64 {
    1.0 - 0.99_f64.powf(1.0 / runs as f64)
}

/// Fails unless the counts fit their expectations, by Pearson's chi-square test.
///
/// Cells that expect fewer than 5 are pooled; a count where nothing is expected fails at once.
pub fn assert_fits(observed: &[u64], expected: &[f64], runs: usize, what: &str) {
    let p = chi_square(observed, expected, what);
    assert!(p >= sidak(runs), "{what}: chi-square p = {p:e}, below {:e}", sidak(runs));
}

/// The probability of a fit this bad or worse.
pub fn chi_square(observed: &[u64], expected: &[f64], what: &str) -> f64 {
    assert_eq!(observed.len(), expected.len());
    let (mut statistic, mut cells) = (0.0, 0_usize);
    let (mut pooled_observed, mut pooled_expected) = (0_u64, 0.0);
    let mut add = |observed: u64, expected: f64| {
        statistic += (observed as f64 - expected).powi(2) / expected;
        cells += 1;
    };
    for (cell, (&observed, &expected)) in observed.iter().zip(expected).enumerate() {
        assert!(expected > 0.0 || observed == 0, "{what}: {observed} in cell {cell}, expected 0");
        if expected >= 5.0 {
            add(observed, expected);
        } else {
            pooled_observed += observed;
            pooled_expected += expected;
        }
    }
    if pooled_expected >= 5.0 {
        add(pooled_observed, pooled_expected);
    }
    assert!(cells > 1, "{what}: too few samples for a test");
    gamma_q((cells - 1) as f64 / 2.0, statistic / 2.0)
}

/// Fails unless a mean of samples with this standard error may have `expected` for its truth: a
/// two-sided Z test.
pub fn assert_mean(mean: f64, standard_error: f64, expected: f64, runs: usize, what: &str) {
    let z = (mean - expected) / standard_error;
    let p = gamma_q(0.5, z * z / 2.0);
    assert!(p >= sidak(runs), "{what}: mean {mean}, expected {expected}, Z = {z}, p = {p:e}");
}

/// Mean and standard error of a sample.
pub fn mean(samples: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut count, mut mean, mut squares) = (0.0, 0.0, 0.0);
    for x in samples {
        // Welford's update.
        count += 1.0;
        let delta = x - mean;
        mean += delta / count;
        squares += delta * (x - mean);
    }
    (mean, (squares / (count - 1.0) / count).sqrt())
}

/// The regularised upper incomplete gamma function Q(a, x): series below a + 1, continued fraction
/// above (Press et al., *Numerical Recipes*, 3rd edition, section 6.2).
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
        return 1.0 - sum * scale;
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

/// Table values, from Abramowitz and Stegun, table 26.8, and of the normal distribution.
#[test]
fn tail_probabilities_are_those_of_the_tables() {
    for (degrees, chi2, p) in
        [(1.0, 3.84146, 0.05), (10.0, 23.2093, 0.01), (30.0, 50.8922, 0.01), (100.0, 118.498, 0.1)]
    {
        let q = gamma_q(degrees / 2.0, chi2 / 2.0);
        assert!(
            (q - p).abs() < 1e-5 * (1.0 + p),
            "{degrees} degrees of freedom: {q}, expected {p}"
        );
    }
    assert!((gamma_q(0.5, 1.959_964_f64.powi(2) / 2.0) - 0.05).abs() < 1e-6);
}

/// The harness has to see a density that is wrong by 2 % over half of its domain, and let a right one
/// pass.
#[test]
fn chi_square_tells_a_small_bias() {
    let expected = [1e4; 100];
    let run = |bias: f64| {
        let mut rng = super::Rng::new(1, 0);
        let mut observed = [0; 100];
        for _ in 0..1_000_000 {
            let upper = rng.f64() < 0.5 + bias;
            observed[rng.below(50) + if upper { 50 } else { 0 }] += 1;
        }
        chi_square(&observed, &expected, "bias")
    };
    assert!(run(0.0) > 0.01);
    assert!(run(0.01) < 1e-6);
}
