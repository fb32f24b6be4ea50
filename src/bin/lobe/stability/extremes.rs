//! Random numbers at 0 and just below 1: how integers become floats, and what warps make of the extremes.

use std::f32::consts::PI;
use std::f64::consts::TAU;

use lobe::film::{Filter, FilterSampler};
use lobe::geometry::float::ONE_MINUS_EPSILON;
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::sampling::{
    BlueNoiseSampler, Discrete, IndependentSampler, SampleId, Sampler, SobolSampler,
    SphericalRectangle, StratifiedSampler, concentric_disk, cosine_hemisphere, uniform_cone,
    uniform_triangle,
};

use super::tally::{half_decades, measured};
use super::usual_rectangle::UsualRectangle;
use super::{Method, Sweep};

/// Whether a 1 comes out among many numbers.
pub fn ones(effort: f64) -> Sweep {
    let parameters = half_decades(4, 9);
    let most = (3e8 * effort).clamp(1e5, 3e8);
    // Only the largest integers can become 1.
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
        title: "Chance of a 1 among random numbers below 1, by how many are drawn",
        about: "Integers become f32 and are divided by their range. Of the largest 2^16 integers all are tried, and the chance follows in \
                closed form: rounding makes 1 of one in 2^25. Ours are numbers that the crate's four samplers really gave, in turns of \
                1000: 1 if one of them is 1, and 0 if none is."
            .to_owned(),
        parameter: "numbers drawn",
        log_parameter: true,
        measure: "chance that one of them is 1",
        methods,
        fails_from: 1e-3,
        bounds: vec![0.0; parameters.len()],
        parameters,
    }
}

/// How many numbers of the samplers come before the first 1, of `most`.
fn first_ones(most: u64) -> u64 {
    let samplers: [&dyn Sampler; 4] = [
        &IndependentSampler::new(1),
        &StratifiedSampler::new(1000, 1),
        &SobolSampler::new(1),
        &BlueNoiseSampler::new(UVec2::splat(1 << 10), 1024, 1),
    ];
    let (mut ids, mut points) = (Vec::new(), Vec::new());
    let mut taken = 0;
    for turn in 0.. {
        // The independent one is the fastest, and the only one whose numbers are not spread evenly.
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

/// k from 1 to 32: at the ends each one, between them each other one.
fn exponents() -> impl Iterator<Item = f64> {
    (1..=32).filter(|k| !(5..24).contains(k) || k % 2 == 0).map(f64::from)
}

/// Warps just below 1.
pub fn near_one(_effort: f64) -> Sweep {
    let parameters: Vec<f64> = exponents().collect();
    let usual = |k: f64| (1.0 - 2.0_f64.powf(-k)) as f32;
    // As the samplers cut it off.
    let methods = fail(&parameters, usual, |k| usual(k).min(ONE_MINUS_EPSILON));
    Sweep {
        name: "extremes-near-one",
        title: "Warps that fail just below 1",
        about: about(
            "1 - 2^-k",
            "which for k from 25 on f32 rounds to 1; ours stop at 1 - 2^-24, the largest that samplers give",
        ),
        parameter: "k, where u is 1 - 2^-k",
        bounds: vec![0.0; parameters.len()],
        ..warps(parameters, methods)
    }
}

/// Warps just above 0.
pub fn near_zero(_effort: f64) -> Sweep {
    let parameters: Vec<f64> = exponents().chain([33.0]).collect();
    let usual = |k: f64| if k > 32.0 { 0.0 } else { 2.0_f64.powf(-k) as f32 };
    let ours = |k: f64| if k > 24.0 { 0.0 } else { 2.0_f64.powf(-k) as f32 };
    let methods = fail(&parameters, usual, ours);
    Sweep {
        name: "extremes-near-zero",
        title: "Warps that fail just above 0",
        about: about(
            "2^-k",
            "and 0 at k = 33; ours are 0 from k = 25 on, the next number that samplers give",
        ) + " What ours has left is the hemisphere at 0, on the border of the square, where the density is zero: numbers of 32 bits would avoid it down to 2^-32.",
        parameter: "k, where u is 2^-k; 33 stands for u = 0",
        bounds: parameters.iter().map(|&k| if k > 24.0 { 0.125 } else { 0.0 }).collect(),
        ..warps(parameters, methods)
    }
}

fn about(u: &str, note: &str) -> String {
    format!(
        "Eight warps, each by a usual formula and by the crate's function of the same purpose, where one coordinate is {u}, {note}, and the \
         other one a multiple of 1/64 or the same. Failures: NaN, a weight below zero, a direction that is not of unit length by 1e-4, of zero \
         density, or out of its cone's place by 1 % of the cone, an index beyond the end or of weight zero, a point outside of the \
         rectangle. Usual: PBRT's triangle by √u, its hemisphere by √(1 - x² - y²) and its cone by cos θ; Shirley and Chiu without a case for \
         the middle; a search through sums of weights in f32; floor(n u); Ureña's rectangle in f32; Box and Muller's Gaussian."
    )
}

fn warps(parameters: Vec<f64>, methods: Vec<Method>) -> Sweep {
    Sweep {
        name: "",
        title: "",
        about: String::new(),
        parameter: "",
        log_parameter: false,
        measure: "share of warps that fail",
        methods,
        fails_from: 0.1,
        bounds: Vec::new(),
        parameters,
    }
}

/// Whether a warp gives something sound for u.
type Sound<'a> = &'a dyn Fn(Vec2) -> bool;

/// The shares of warps that fail at what `usual` and `ours` make of each parameter.
fn fail(
    parameters: &[f64],
    usual: impl Fn(f64) -> f32 + Sync,
    ours: impl Fn(f64) -> f32 + Sync,
) -> Vec<Method> {
    let named = [("usual warps", false), ("the crate's warps (ours)", true)];
    measured(parameters, named, |_, k| {
        let share = |warps: [Sound; 8], extreme: f32| {
            let others = (1..64).map(|i| i as f32 / 64.0).chain([extreme]);
            let points: Vec<Vec2> = others
                .flat_map(|other| [Vec2::new(extreme, other), Vec2::new(other, extreme)])
                .collect();
            let fails = |warp: &&Sound| points.iter().any(|&u| !warp(u));
            warps.iter().filter(fails).count() as f64 / 8.0
        };
        [usual_share(&share, usual(k)), our_share(&share, ours(k))]
    })
}

/// What counts the failures of eight warps.
type Share<'a> = &'a dyn Fn([Sound; 8], f32) -> f64;

fn usual_share(share: Share, extreme: f32) -> f64 {
    let sums: Vec<f32> = weights()
        .scan(0.0, |sum, weight| {
            *sum += (weight / weights().sum::<f64>()) as f32;
            Some(*sum)
        })
        .collect();
    let [corner, ex, ey] = RECTANGLE;
    let rectangle = UsualRectangle::new(Vec3::ZERO, corner, ex, ey);
    share(
        [
            &|u| are_weights(Vec2::new(1.0 - u.x.sqrt(), u.y * u.x.sqrt())),
            &|u| {
                let Vec2 { x, y } = u.x.sqrt() * Vec2::from_angle(2.0 * PI * u.y);
                has_density(Vec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt()))
            },
            &|u| {
                let cos_max = (f64::from(SUN)).cos() as f32;
                let cos = 1.0 - u.x * (1.0 - cos_max);
                is_in_cone((1.0 - cos * cos).max(0.0).sqrt() * Vec2::from_angle(2.0 * PI * u.y), u)
            },
            &|u| {
                let Vec2 { x: a, y: b } = 2.0 * u - 1.0;
                let (r, share) = if a.abs() > b.abs() { (a, b / a) } else { (b, 2.0 - a / b) };
                (r * Vec2::from_angle(0.25 * PI * share)).is_finite()
            },
            &|u| has_weight(sums.iter().take_while(|&&sum| sum < u.x).count()),
            &|u| ((u.x * CELLS as f32) as usize) < CELLS,
            &|u| is_inside(rectangle.sample(u)),
            &|u| {
                let radius = 0.5 * (-2.0 * u.x.ln()).sqrt();
                (radius * Vec2::from_angle(2.0 * PI * u.y)).is_finite()
            },
        ],
        extreme,
    )
}

fn our_share(share: Share, extreme: f32) -> f64 {
    let [corner, ex, ey] = RECTANGLE;
    let rectangle = SphericalRectangle::new(Vec3::ZERO, corner, ex, ey);
    let by_weight = Discrete::new(weights());
    let cells = Discrete::new([1.0; CELLS]);
    let filter = FilterSampler::new(Filter::gaussian());
    share(
        [
            &|u| are_weights(uniform_triangle::sample(u)),
            &|u| has_density(cosine_hemisphere::sample(u)),
            &|u| {
                let height = uniform_cone::height((f64::from(SUN).sin().powi(2)) as f32);
                is_in_cone(uniform_cone::sample(u, height).truncate(), u)
            },
            &|u| concentric_disk::sample(u).is_finite(),
            &|u| by_weight.as_ref().is_some_and(|choice| has_weight(choice.sample(u.x).0)),
            &|u| cells.as_ref().is_some_and(|choice| choice.sample(u.x).0 < CELLS),
            &|u| rectangle.as_ref().is_some_and(|rectangle| is_inside(rectangle.sample(u))),
            &|u| filter.as_ref().is_ok_and(|filter| filter.sample(u).is_finite()),
        ],
        extreme,
    )
}

/// The sun's angular radius.
const SUN: f32 = 0.004_65;
/// Cells of a table.
const CELLS: usize = 16;
/// How many weights there are; the first and the last are zero.
const WEIGHTS: usize = 5002;
/// Corner and edges, seen from zero.
const RECTANGLE: [Vec3; 3] = [Vec3::new(-0.5, -0.25, 1.0), Vec3::X, Vec3::Y];

fn weights() -> impl Iterator<Item = f64> {
    (0..WEIGHTS).map(|i| if has_weight(i) { 1.0 } else { 0.0 })
}

fn has_weight(index: usize) -> bool {
    (1..WEIGHTS - 1).contains(&index)
}

fn are_weights(b: Vec2) -> bool {
    b.x >= 0.0 && b.y >= 0.0 && 1.0 - b.x - b.y >= 0.0
}

fn has_density(w: Vec3) -> bool {
    (w.length() - 1.0).abs() < 1e-4 && w.z / PI > 0.0
}

/// Whether the direction with these x and y is where u leads within the sun's disk: 1 - cos θ grows with u.x.
fn is_in_cone(across: Vec2, u: Vec2) -> bool {
    let height = 2.0 * (0.5 * f64::from(SUN)).sin().powi(2);
    let below = f64::from(u.x) * height;
    let (sin, cos) = (TAU * f64::from(u.y)).sin_cos();
    let truth = lobe::glam::DVec2::new(cos, sin) * (below * (2.0 - below)).sqrt();
    (across.as_dvec2() - truth).length() < 0.01 * f64::from(SUN)
}

fn is_inside(point: Vec3) -> bool {
    let [corner, ..] = RECTANGLE;
    let moved = point - corner;
    let edges = -1e-5..=1.0 + 1e-5;
    edges.contains(&moved.x) && edges.contains(&moved.y) && moved.z.abs() < 1e-5
}
