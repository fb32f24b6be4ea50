//! Conversion of integers to floats.

use lobe::glam::{UVec2, Vec2};
use lobe::sampling::{
    BlueNoiseSampler, IndependentSampler, SampleId, Sampler, SobolSampler, StratifiedSampler,
};

use super::super::sweep::{Method, Sweep};
use super::super::tally::half_decades;

/// Probability that a 1 is among many random numbers.
pub fn ones(effort: f64) -> Sweep {
    let parameters = half_decades(4, 9);
    let most = (3e8 * effort).clamp(1e5, 3e8);
    // Only integers close to the maximum can be rounded to 1.
    let ones = |integers: u64, one: f32| {
        let top = integers - (1 << 16)..integers;
        top.filter(|&bits| bits as f32 / one >= 1.0).count() as f64 / integers as f64
    };
    let word = ones(1 << 32, (1_u64 << 32) as f32);
    let rand = ones(1 << 31, ((1_u64 << 31) - 1) as f32);
    let chance = |share: f64, n: f64| -(n * (-share).ln_1p()).exp_m1();
    let firsts = first_ones(most as u64);
    let ours = |n: f64| if n > most { f64::NAN } else { f64::from(u8::from(firsts < n as u64)) };
    let column = |name, is_ours, values: &dyn Fn(f64) -> f64| Method {
        name,
        is_ours,
        values: parameters.iter().map(|&n| values(n)).collect(),
    };
    let methods = vec![
        column("32 bits times 2^-32", false, &|n| chance(word, n)),
        column("rand() / RAND_MAX, 31 bits", false, &|n| chance(rand, n)),
        column("samplers, 24 bits (ours)", true, &ours),
    ];
    Sweep {
        name: "extremes-ones",
        title: "Probability of a 1 among random numbers below 1, by how many are drawn",
        about: "Integers become f32 and are divided by their range. The largest 2^16 integers are all tried, and the \
                probability follows in closed form: one in 2^25 is rounded to 1. Ours are numbers from the crate's four \
                samplers, in turns of 1000: 1 if one of them is 1, and 0 if none is."
            .to_owned(),
        parameter: "numbers drawn",
        log_parameter: true,
        measure: "probability that one of them is 1",
        methods,
        fails_from: 1e-3,
        bounds: vec![0.0; parameters.len()],
        parameters,
    }
}

/// Number of random numbers from the samplers before the first 1; `u64::MAX` if there is none among `most`.
fn first_ones(most: u64) -> u64 {
    let samplers: [&dyn Sampler; 4] = [
        &IndependentSampler::new(1),
        &StratifiedSampler::new(1000, 1),
        &SobolSampler::new(1),
        &BlueNoiseSampler::new(UVec2::splat(1 << 10), 1024, 1),
    ];
    let (mut ids, mut points) = (Vec::new(), [Vec2::ZERO; 1000]);
    let mut taken = 0;
    for turn in 0.. {
        // Mostly the independent sampler, which is the fastest and the only one whose numbers are not stratified.
        let sampler = samplers[if turn % 16 < 3 { 1 + turn as usize % 16 } else { 0 }];
        let pixel = UVec2::new(turn % 1024, turn / 1024 % 1024);
        ids.clear();
        ids.extend((0..1000).map(|index| SampleId { pixel, set: turn >> 20, index }));
        sampler.fill_2d(&ids, 0, &mut points);
        let largest = points.iter().copied().fold(Vec2::ZERO, Vec2::max).max_element();
        if largest >= 1.0 {
            break;
        }
        taken += 2000;
        if taken >= most {
            return u64::MAX;
        }
    }
    taken
}
