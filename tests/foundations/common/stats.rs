//! Statistics: chi-square and Z tests at a stated significance.
//!
//! All tests are held to a significance of 0.01 with the Šidák correction over all runs of one test:
//! a right program fails it for one seed in a hundred.

use lobe::check::statistics::{Mean, chi_square, significance, two_sided};

/// Fails unless the counts fit their expectations, by Pearson's chi-square test.
///
/// Cells that expect fewer than 5 are pooled; a count where nothing is expected fails at once.
pub fn assert_fits(observed: &[u64], expected: &[f64], runs: usize, what: &str) {
    let (p, least) = (fit(observed, expected, what), significance(runs as u32));
    assert!(p >= least, "{what}: chi-square p = {p:e}, below {least:e}");
}

/// The probability of a fit this bad or worse.
fn fit(observed: &[u64], expected: &[f64], what: &str) -> f64 {
    assert_eq!(observed.len(), expected.len());
    for (cell, (&observed, &expected)) in observed.iter().zip(expected).enumerate() {
        assert!(expected > 0.0 || observed == 0, "{what}: {observed} in cell {cell}, expected 0");
    }
    let cells = expected.iter().filter(|&&expected| expected >= 5.0).count();
    assert!(cells > 1, "{what}: too few samples for a test");
    chi_square(observed.iter().copied().zip(expected.iter().copied()))
}

/// Fails unless a mean of samples with this standard error may have `expected` for its truth: a
/// two-sided Z test.
pub fn assert_mean(mean: f64, standard_error: f64, expected: f64, runs: usize, what: &str) {
    let z = (mean - expected) / standard_error;
    let p = two_sided(z);
    assert!(
        p >= significance(runs as u32),
        "{what}: mean {mean}, expected {expected}, Z = {z}, p = {p:e}"
    );
}

/// Mean and standard error of a sample.
pub fn mean(samples: impl Iterator<Item = f64>) -> (f64, f64) {
    let mut mean = Mean::default();
    samples.for_each(|x| mean.add(x));
    (mean.mean, mean.standard_error())
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
        fit(&observed, &expected, "bias")
    };
    assert!(run(0.0) > 0.01);
    assert!(run(0.01) < 1e-6);
}
