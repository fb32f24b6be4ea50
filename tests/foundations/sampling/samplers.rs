//! Samplers: pure functions, uniform, independent wherever the contract says so, stratified.

use std::collections::BTreeMap;

use lobe::accel::InstructionSet;
use lobe::glam::{UVec2, Vec2};
use lobe::sampling::{
    BlueNoiseSampler, IndependentSampler, SampleId, Sampler, SobolSampler, StratifiedSampler,
};

use crate::common::Rng;
use crate::common::stats::assert_fits;

fn id(x: u32, y: u32, index: u32) -> SampleId {
    SampleId { pixel: UVec2::new(x, y), set: 0, index }
}

/// All samplers; that of blue noise for an image of one pixel, so that pixels are independent.
pub fn samplers(spp: u32, seed: u64) -> [(&'static str, Box<dyn Sampler>); 4] {
    samplers_for(InstructionSet::fastest(), UVec2::ONE, spp, seed)
}

/// All samplers, with these instructions; that of blue noise for an image of this size.
fn samplers_for(
    set: InstructionSet,
    size: UVec2,
    spp: u32,
    seed: u64,
) -> [(&'static str, Box<dyn Sampler>); 4] {
    let blue_noise = BlueNoiseSampler::new(size, spp, seed);
    [
        ("independent", Box::new(IndependentSampler::new(seed).with_instruction_set(set))),
        ("stratified", Box::new(StratifiedSampler::new(spp, seed).with_instruction_set(set))),
        ("sobol", Box::new(SobolSampler::new(seed).with_instruction_set(set))),
        ("blue noise", Box::new(blue_noise.with_instruction_set(set))),
    ]
}

/// `fill` gives the bits of single calls of `get`, with each instruction set, for runs of any length, samples with gaps,
/// and changes of set and pixel within a block. Seen to fail with the seeds of the first sample for a whole block, with its
/// neighbour instead of the last sample of a short block, and with a pixel's place kept where its set ends.
#[test]
fn fills_equal_gets() {
    let of = |x, set, index| SampleId { pixel: UVec2::new(x, 5), set, index };
    let pools: [&dyn Fn(u32) -> SampleId; 7] = [
        &|i| of(3, 0, i),
        &|i| of(3, 1, 7 + i + i / 3 * 2),
        &|i| of(3, i / 7, i % 7),
        &|i| of(3 + i / 20, 0, i % 20),
        &|i| of(3 + i, i % 2, 0),
        &|i| of(3 + i / 70, i / 70, i % 70),
        &|i| of(3, i / 3, (i * 37) << 20),
    ];
    let (mut values, mut points) = ([0.5; 150], [Vec2::ONE; 150]);
    let sets = InstructionSet::available();
    for (spp, size) in [(16, UVec2::ONE), (100, UVec2::new(100, 30))] {
        let samplers = sets.iter().flat_map(|&set| {
            samplers_for(set, size, spp, 4).map(|(name, sampler)| (set, name, sampler))
        });
        for (set, name, sampler) in samplers {
            for (p, pool) in pools.iter().enumerate() {
                let ids: Vec<_> = (0..150).map(pool).collect();
                for dimension in [0, 1, 2, 3, u32::MAX] {
                    let one: Vec<_> = ids.iter().map(|&id| sampler.get_1d(id, dimension)).collect();
                    let two: Vec<_> = ids.iter().map(|&id| sampler.get_2d(id, dimension)).collect();
                    for count in (0..=100).chain([127, 128, 129, 150]) {
                        let (values, points) = (&mut values[..count], &mut points[..count]);
                        sampler.fill_1d(&ids[..count], dimension, values);
                        sampler.fill_2d(&ids[..count], dimension, points);
                        assert!(
                            *values == one[..count] && *points == two[..count],
                            "{name} with {set}: {count} of pool {p} in dimension {dimension}",
                        );
                    }
                }
            }
        }
    }
}

/// Equal arguments give equal samples, in any order and on any thread. Caught: a counter in the
/// sampler.
#[test]
fn a_sample_is_a_function_of_its_id() {
    let questions: Vec<_> =
        (0..4000).map(|i| (id(i % 7, i / 7 % 5, i / 35 % 23), i / 805)).collect();
    for (name, sampler) in samplers(16, 99) {
        let ask = |&(id, d): &(SampleId, u32)| {
            (sampler.get_1d(id, d).to_bits(), sampler.get_2d(id, d).to_array().map(f32::to_bits))
        };
        let forwards: Vec<_> = questions.iter().map(ask).collect();
        let mut backwards: Vec<_> = questions.iter().rev().map(ask).collect();
        backwards.reverse();
        assert_eq!(forwards, backwards, "{name}");
        let elsewhere = std::thread::scope(|scope| {
            scope.spawn(|| questions.iter().map(ask).collect::<Vec<_>>()).join()
        });
        assert_eq!(forwards, elsewhere.unwrap(), "{name}");
    }
}

/// Caught: 32 bits scaled by 2⁻³², one in 2²⁵ of which rounds to 1.
#[test]
fn common_values_stay_below_one() {
    let sampler = IndependentSampler::new(1);
    let below = (0..1 << 27).all(|i| sampler.get_2d(id(1, 2, i), 0).max_element() < 1.0);
    assert!(below);
}

/// In a set this large the last stratum has room for two floats below 1, and rounds up half of the
/// time. Caught: the stratified place without its upper limit.
#[test]
fn large_sets_stay_below_one() {
    let spp = (1 << 23) + 1;
    let sampler = StratifiedSampler::new(spp, 1);
    assert!((0..6 * spp).all(|i| sampler.get_1d(id(1, 2, i), 0) < 1.0));
}

/// Caught: a length whose next power of two is not a u32.
#[test]
fn extreme_ids_have_values_too() {
    for trial in 0..300_000 {
        let mut rng = Rng::new(30, trial);
        let extreme = |rng: &mut Rng| match rng.below(4) {
            0 => 0,
            1 => u32::MAX,
            _ => rng.bits() as u32,
        };
        let spp = [1, 2, 3, 64, 1000, 65_537, u32::MAX][rng.below(7)];
        let id = id(extreme(&mut rng), extreme(&mut rng), extreme(&mut rng));
        let dimension = extreme(&mut rng);
        for (name, sampler) in samplers(spp, rng.bits()) {
            let (x, p) = (sampler.get_1d(id, dimension), sampler.get_2d(id, dimension));
            for value in [x, p.x, p.y] {
                assert!((0.0..1.0).contains(&value), "{name}, trial {trial}: {value}");
            }
        }
    }
}

/// Where one part of a sample's name runs and the others stand still.
type Walk = fn(u32) -> (u64, SampleId, u32);
const WALKS: [(&str, Walk); 5] = [
    ("index", |i| (5, id(3, 4, i), 2)),
    ("column", |i| (5, id(i, 4, 1), 2)),
    ("row", |i| (5, id(3, i, 1), 2)),
    ("dimension", |i| (5, id(3, 4, 1), i)),
    ("seed", |i| (u64::from(i), id(3, 4, 1), 2)),
];

/// Uniform in one and two dimensions, whichever part of the name runs. 1,048,576 samples over 1024
/// cells. Caught: `hash` without its last `mix`.
#[test]
fn uniform_whatever_runs() {
    const COUNT: u32 = 1 << 20;
    let expected = [f64::from(COUNT) / 1024.0; 1024];
    for (walk, name_of) in WALKS {
        for kind in 0..4 {
            let (mut one, mut two) = ([0; 1024], [0; 1024]);
            let mut sampler = samplers(16, 5);
            for i in 0..COUNT {
                let (seed, id, dimension) = name_of(i);
                if seed != 5 {
                    sampler = samplers(16, seed);
                }
                let sampler = &sampler[kind].1;
                one[(sampler.get_1d(id, dimension) * 1024.0) as usize] += 1;
                two[cell(sampler.get_2d(id, dimension))] += 1;
            }
            let name = samplers(1, 0)[kind].0;
            assert_fits(&one, &expected, 40, &format!("{name}, 1D, by {walk}"));
            assert_fits(&two, &expected, 40, &format!("{name}, 2D, by {walk}"));
        }
    }
}

/// One of 32 × 32 cells of the square.
fn cell(p: Vec2) -> usize {
    (p.x * 32.0) as usize * 32 + (p.y * 32.0) as usize
}

/// Neighbouring samples are independent in every direction: pairs fill the square. Caught: pixel and
/// index folded together without a `mix` between; index and dimension by XOR; one key for all
/// dimensions of the stratified sampler.
#[test]
fn neighbours_are_independent() {
    const COUNT: u32 = 1 << 18;
    let expected = [f64::from(COUNT) / 1024.0; 1024];
    const ONE_SEQUENCE: &str = "sets of 16 that follow each other";
    type Pair = (&'static str, fn(u32) -> [(u64, SampleId, u32); 2]);
    let pairs: [Pair; 10] = [
        ("columns", |i| [(5, id(i, 0, 0), 0), (5, id(i + 1, 0, 0), 0)]),
        ("rows", |i| [(5, id(7, i, 0), 0), (5, id(7, i + 1, 0), 0)]),
        ("column and row", |i| [(5, id(i, 1, 0), 0), (5, id(1, i, 0), 0)]),
        ("dimensions", |i| [(5, id(i, 9, 3), 0), (5, id(i, 9, 3), 1)]),
        ("dimension and index", |i| [(5, id(i, 9, 1), 2), (5, id(i, 9, 2), 1)]),
        ("column and index", |i| [(5, id(i, 9, 3), 1), (5, id(i + 1, 9, 2), 1)]),
        ("row and dimension", |i| [(5, id(9, i, 3), 1), (5, id(9, i + 1, 3), 0)]),
        ("sets", |i| [(5, id(i, 2, 3), 4), (5, SampleId { set: 1, ..id(i, 2, 3) }, 4)]),
        (ONE_SEQUENCE, |i| [(5, id(i, 2, 3), 4), (5, id(i, 2, 3 + 16), 4)]),
        ("seeds", |i| [(u64::from(i), id(6, 2, 3), 4), (u64::from(i) + 1, id(6, 2, 3), 4)]),
    ];
    for (what, pair) in pairs {
        for kind in 0..4 {
            let name = samplers(1, 0)[kind].0;
            // To the Sobol sampler, which knows of no size, these are one set.
            if name == "sobol" && what == ONE_SEQUENCE {
                continue;
            }
            let mut observed = [[0; 1024]; 3];
            for i in 0..COUNT {
                let [a, b] = pair(i).map(|(seed, id, dimension)| {
                    let sampler = &samplers(16, seed)[kind].1;
                    (sampler.get_1d(id, dimension), sampler.get_2d(id, dimension))
                });
                observed[0][cell(Vec2::new(a.0, b.0))] += 1;
                observed[1][cell(Vec2::new(a.1.x, b.1.x))] += 1;
                observed[2][cell(Vec2::new(a.1.x, b.1.y))] += 1;
            }
            for (projection, observed) in observed.iter().enumerate() {
                assert_fits(
                    observed,
                    &expected,
                    117,
                    &format!("{name}: {what}, projection {projection}"),
                );
            }
        }
    }
}

/// Images of neighbouring seeds share no pixel. Caught: pixel and seed folded together by XOR alone,
/// which makes the image of seed 1 that of seed 0 with its rows swapped in pairs.
#[test]
fn no_two_seeds_share_a_pixel() {
    let mut seen = BTreeMap::new();
    for seed in 0..64 {
        for pixel in 0..256 {
            for (name, sampler) in samplers(1, seed) {
                let id = id(pixel % 16, pixel / 16, 0);
                let point = sampler.get_2d(id, 0);
                // Two 24-bit numbers: among 32,768 points a match by chance has the odds 2⁻¹⁹.
                let key = point.to_array().map(f32::to_bits);
                let before = seen.insert(key, (name, seed, id.pixel));
                // With one sample per pixel samplers may agree with each other.
                let same = before.is_none_or(|b| (b.1, b.2) == (seed, id.pixel));
                assert!(same, "{name}, seed {seed}, {id:?} is the point of {before:?}");
            }
        }
    }
}

/// Each set has one sample in each stratum, in one dimension, and at most one in each cell of the
/// grid, in two. Caught: the permutation without cycle walking, and jitter over two cells.
///
/// A sample may be rounded onto the border of its stratum, so they are sorted and each is looked for
/// in its own, to 2⁻²³.
#[test]
fn sets_are_stratified() {
    for spp in [1, 2, 3, 4, 5, 7, 8, 16, 17, 60, 64, 100, 256, 1000] {
        for set in 0..20 {
            let sampler = StratifiedSampler::new(spp, 3);
            let ids = (0..spp).map(|i| id(set, 1, set * spp + i));
            let mut values: Vec<f64> =
                ids.clone().map(|id| sampler.get_1d(id, set).into()).collect();
            values.sort_by(f64::total_cmp);
            let tolerance = f64::from(spp) * 2.0_f64.powi(-23);
            for (stratum, value) in values.into_iter().enumerate() {
                let place = value * f64::from(spp) - stratum as f64;
                assert!(
                    place >= -tolerance && place <= 1.0 + tolerance,
                    "{spp} samples, set {set}: stratum {stratum} has {value}"
                );
            }

            let columns = spp.isqrt();
            let rows = spp.div_ceil(columns);
            let mut taken = vec![false; (columns * rows) as usize];
            for id in ids {
                let p = sampler.get_2d(id, set);
                let cell = (p.x * columns as f32) as u32 + (p.y * rows as f32) as u32 * columns;
                let before = std::mem::replace(&mut taken[cell as usize], true);
                assert!(!before, "{spp} samples, set {set}: two in cell {cell}");
            }
        }
    }
}

/// What lies beyond a set begins another one. Caught: an index taken modulo the set's length for the
/// key too.
#[test]
fn sets_differ() {
    let sampler = StratifiedSampler::new(16, 0);
    let order = |set: u32| -> Vec<u32> {
        (0..16).map(|i| (sampler.get_1d(id(0, 0, 16 * set + i), 0) * 16.0) as u32).collect()
    };
    let distinct: std::collections::BTreeSet<_> = (0..100).map(order).collect();
    assert_eq!(distinct.len(), 100, "of 16! orders, 100 random ones differ");
}
