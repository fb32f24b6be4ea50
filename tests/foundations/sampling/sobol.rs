//! The Sobol sampler: nets in every block, scrambled as Owen asks for, and what comes of it.

use std::f64::consts::TAU;

use lobe::glam::{UVec2, Vec2};
use lobe::sampling::{SampleId, Sampler, SobolSampler};

use crate::common::stats::{assert_fits, assert_mean, mean};

fn id(x: u32, set: u32, index: u32) -> SampleId {
    SampleId { pixel: UVec2::new(x, 9), set, index }
}

/// The first indices of aligned blocks of 1024.
const FIRSTS: [u32; 6] = [0, 1024, 1 << 16, (1 << 16) + 3072, (1 << 31) - 1024, u32::MAX - 1023];

/// Fails unless each of the boxes that `box_of` tells apart has one of the points.
pub fn assert_one_each<T: Copy>(points: &[T], box_of: impl Fn(T) -> usize, what: &str) {
    let mut taken = vec![false; points.len()];
    for &p in points {
        let before = std::mem::replace(&mut taken[box_of(p)], true);
        assert!(!before, "{what}: two points in box {}", box_of(p));
    }
}

/// The cell of `x` among 2ᵏ.
fn cell(x: f32, k: u32) -> usize {
    (f64::from(x) * f64::from(1 << k)) as usize
}

/// Each aligned block of 2ᵏ samples has one in each elementary interval of every shape. Caught: the scramble with
/// an odd constant in place of its last; the second coordinates without the sum of bits.
#[test]
fn blocks_are_nets() {
    for (dimension, (pixel, set)) in [0, 1, 2, 3, 7, 1000, u32::MAX]
        .into_iter()
        .zip([(0, 0), (1, 0), (0, 1), (77, 5)].into_iter().cycle())
    {
        let sampler = SobolSampler::new(7);
        for first in FIRSTS {
            for k in 0..=10 {
                let ids = (0..1 << k).map(|i| id(pixel, set, first + i));
                let what = format!("2^{k} samples from {first}, dimension {dimension}");
                let values: Vec<f32> =
                    ids.clone().map(|id| sampler.get_1d(id, dimension)).collect();
                assert_one_each(&values, |x| cell(x, k), &what);
                let points: Vec<Vec2> = ids.map(|id| sampler.get_2d(id, dimension)).collect();
                for columns in 0..=k {
                    let rows = k - columns;
                    let box_of = |p: Vec2| cell(p.x, columns) << rows | cell(p.y, rows);
                    assert_one_each(&points, box_of, &format!("{what}, {columns} + {rows} bits"));
                }
            }
        }
    }
}

/// 4ᵏ samples of dimensions d and d + 2 have one in each four-dimensional box with sides that are powers of 1/4.
/// Caught: dimensions coupled with their neighbours instead; w² in place of w in the first
/// step of coordinate 2.
#[test]
fn couples_are_nets_in_base_4() {
    let sampler = SobolSampler::new(1);
    for (dimension, first) in [0, 1, 4, 9].into_iter().flat_map(|d| FIRSTS.map(|first| (d, first)))
    {
        for k in 0..=5_u32 {
            let points: Vec<[f32; 4]> = (0..1 << (2 * k))
                .map(|i| {
                    let [a, b] = [0, 2].map(|d| sampler.get_2d(id(3, 0, first + i), dimension + d));
                    [a.x, a.y, b.x, b.y]
                })
                .collect();
            for shape in 0..(k + 1).pow(3) {
                let sides = [shape % (k + 1), shape / (k + 1) % (k + 1), shape / (k + 1).pow(2)];
                let Some(last) = k.checked_sub(sides.iter().sum()) else { continue };
                let bits = [sides[0], sides[1], sides[2], last].map(|side| 2 * side);
                let box_of = |p: [f32; 4]| {
                    p.into_iter().zip(bits).fold(0, |i, (x, bits)| i << bits | cell(x, bits))
                };
                let what = format!("dimension {dimension}, 4^{k} samples from {first}, {bits:?}");
                assert_one_each(&points, box_of, &what);
            }
        }
    }
}

/// The upper digits of scrambled numbers are uniform over pixels, in each coordinate, in both together, and in two
/// samples of one set. Caught: the scramble without its seed.
#[test]
fn scrambles_are_random() {
    const COUNT: u32 = 1 << 18;
    let sampler = SobolSampler::new(3);
    for dimension in [0, 1, 2] {
        let mut observed = [[0; 256]; 4];
        for pixel in 0..COUNT {
            let p = [0, 1].map(|i| sampler.get_2d(id(pixel, 0, i), dimension));
            observed[0][cell(p[0].x, 8)] += 1;
            observed[1][cell(p[0].y, 8)] += 1;
            observed[2][cell(p[0].x, 4) << 4 | cell(p[0].y, 4)] += 1;
            // The second sample is in the other half; the lower digits are as free as the first's.
            let low = |x: f32| cell(x, 5) & 15;
            observed[3][low(p[0].x) << 4 | low(p[1].x)] += 1;
        }
        let expected = [f64::from(COUNT) / 256.0; 256];
        for (kind, observed) in observed.iter().enumerate() {
            assert_fits(observed, &expected, 12, &format!("dimension {dimension}, kind {kind}"));
        }
    }
}

/// Estimates of a known integral by n samples in each of many pixels.
fn estimates(f: impl Fn([Vec2; 3]) -> f64, n: u32) -> impl Iterator<Item = f64> {
    let sampler = SobolSampler::new(11);
    (0..1000).map(move |pixel| {
        let value = |i| f([0, 2, 1].map(|d| sampler.get_2d(id(pixel, 0, i), d)));
        (0..n).map(value).sum::<f64>() / f64::from(n)
    })
}

/// The means of many estimates are right, and from 16 to 1024 samples error falls by at least this power of n. That
/// of independent samples is 1/2, and it is what to expect where dimensions of two couples meet. Caught: dimensions
/// coupled with their neighbours; the scramble without its seed; one order for all couples.
#[test]
fn error_falls_fast() {
    let wave = |p: Vec2| 1.0 + (TAU * f64::from(p.x)).sin() * f64::from(p.y);
    let disc = |p: Vec2| f64::from(u8::from(p.length_squared() < 0.64));
    let disc_mean = TAU / 8.0 * 0.64;
    check("wave", |[p, ..]| wave(p), 1.0, 1.2);
    check("disc", |[p, ..]| disc(p), disc_mean, 0.65);
    check("two waves", |[p, q, _]| wave(p) * wave(q), 1.0, 0.8);
    check("two discs", |[p, q, _]| disc(p) * disc(q), disc_mean * disc_mean, 0.58);
    check("waves of two couples", |[p, _, q]| wave(p) * wave(q), 1.0, 0.4);
}

fn check(name: &str, f: impl Fn([Vec2; 3]) -> f64, truth: f64, slope: f64) {
    let errors = [5, 16, 100, 1024].map(|n| {
        let (mean, error) = mean(estimates(&f, n));
        // 24 bits for each coordinate, rounded down.
        assert_mean(mean, error.hypot(3e-7), truth, 20, &format!("{name}, {n} samples"));
        error
    });
    let found = (errors[1] / errors[3]).ln() / 64_f64.ln();
    println!("{name}: {found:.2}");
    assert!(found > slope, "{name}: error falls with n^-{found:.2}, not n^-{slope}");
}
