//! Selection by weight.

use lobe::sampling::Discrete;

use crate::common::Rng;
use crate::common::stats::assert_fits;

const SAMPLES: u64 = 1_000_000;
const LAST: f32 = 1.0 - 1.0 / (1 << 24) as f32;

fn random_weights(trial: u64) -> Vec<f64> {
    let mut rng = Rng::new(900, trial);
    let count = [1, 2, 3, 10, 100, 1000][trial as usize % 6];
    let skewed = trial % 2 == 1;
    let mut weight = |_| match (rng.below(4), skewed) {
        (0, _) => 0.0,
        (_, true) => 10.0_f64.powf(6.0 * rng.f64()),
        (_, false) => rng.f64(),
    };
    let mut weights: Vec<f64> = (0..count).map(&mut weight).collect();
    weights[count / 2] = 1.0;
    weights
}

/// Chosen by weight, and what is left of the number is uniform whatever was chosen.
#[test]
fn choices_have_their_weights() {
    const TRIALS: u64 = 12;
    for trial in 0..TRIALS {
        let weights = random_weights(trial);
        let discrete = Discrete::new(weights.iter().copied()).unwrap();
        let mut rng = Rng::new(901, trial);
        let (mut chosen, mut left) = (vec![0; weights.len()], vec![0; 16]);
        for _ in 0..SAMPLES {
            let (index, probability, rest) = discrete.sample(rng.f32());
            assert_eq!(probability, discrete.probability(index), "trial {trial}");
            assert!((0.0..1.0).contains(&rest), "trial {trial}: {rest}");
            chosen[index] += 1;
            // Where the share is so small that the number's grid is seen in it, nothing is said.
            if probability > 1e-3 {
                left[(rest * 16.0) as usize] += 1;
            }
        }
        let sum: f64 = weights.iter().sum();
        let expected: Vec<f64> = weights.iter().map(|w| w / sum * SAMPLES as f64).collect();
        if weights.iter().filter(|w| **w > 0.0).count() > 1 {
            assert_fits(&chosen, &expected, 2 * TRIALS as usize, &format!("trial {trial}"));
        }
        let counted = left.iter().sum::<u64>();
        let even = vec![counted as f64 / 16.0; 16];
        if counted > 0 {
            assert_fits(&left, &even, 2 * TRIALS as usize, &format!("trial {trial}: rest"));
        }
    }
}

/// Every u, the borders of shares among them: a choice that has a weight, in order.
#[test]
fn choices_are_ordered_and_never_without_weight() {
    for trial in 0..60 {
        let weights = random_weights(trial);
        let discrete = Discrete::new(weights.iter().copied()).unwrap();
        let mut start = 0.0;
        let mut us = vec![0.0, 1.0 / (1 << 24) as f32, 0.5, LAST];
        for index in 0..weights.len() {
            us.push((start as f32).min(LAST));
            start += f64::from(discrete.probability(index));
        }
        us.sort_by(f32::total_cmp);
        let mut before = 0;
        for u in us {
            let (index, probability, rest) = discrete.sample(u);
            assert!(weights[index] > 0.0 && probability > 0.0, "trial {trial}, u = {u}");
            assert!(index >= before && (0.0..1.0).contains(&rest), "trial {trial}, u = {u}");
            before = index;
        }
    }
}

/// Weights without a positive sum are refused.
#[test]
fn weights_that_add_up_to_nothing_are_refused() {
    for bad in [vec![], vec![0.0], vec![0.0, -1.0, f64::NAN], vec![1.0, f64::INFINITY]] {
        assert!(Discrete::new(bad.clone()).is_none(), "{bad:?}");
    }
    assert_eq!(Discrete::new([f64::NAN, 2.0, -3.0]).unwrap().sample(LAST).0, 1);
}
