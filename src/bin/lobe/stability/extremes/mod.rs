//! Random numbers at 0 and just below 1: conversion from integers, and warps of these values.

mod ones;
mod warps;

pub use ones::ones;

use lobe::geometry::float::ONE_MINUS_EPSILON;
use lobe::glam::Vec2;

use super::sweep::{Method, Sweep};
use super::tally::measured;
use warps::{Sound, our_share, usual_share};

/// k from 1 to 32: all values near the ends, every other one between.
fn exponents() -> impl Iterator<Item = f64> {
    (1..=32).filter(|k| !(5..24).contains(k) || k % 2 == 0).map(f64::from)
}

/// Warps of numbers just below 1.
pub fn near_one(_effort: f64) -> Sweep {
    let parameters: Vec<f64> = exponents().collect();
    let usual = |k: f64| (1.0 - 2.0_f64.powf(-k)) as f32;
    // Clamped as in the samplers.
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
        ..of_warps(parameters, methods)
    }
}

/// Warps of numbers just above 0.
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
        ) + " Of ours, only the hemisphere fails, at 0 on the border of the square, where the density is zero; \
             32-bit random numbers would avoid it down to 2^-32.",
        parameter: "k, where u is 2^-k; 33 stands for u = 0",
        bounds: parameters.iter().map(|&k| if k > 24.0 { 0.125 } else { 0.0 }).collect(),
        ..of_warps(parameters, methods)
    }
}

fn about(u: &str, note: &str) -> String {
    format!(
        "Eight warps, each by a common formula and by the crate's function of the same purpose, where one coordinate \
         is {u}, {note}, and the other one a multiple of 1/64 or the same. Failures: NaN, a weight below zero, a \
         direction that is not of unit length by 1e-4, of zero density, or off by more than 1 % of its \
         cone, an index beyond the end or of weight zero, a point outside of the rectangle. Common formulas: PBRT's triangle \
         by √u, its hemisphere by √(1 - x² - y²) and its cone by cos θ; Shirley and Chiu without a case for the \
         middle; a search through sums of weights in f32; floor(n u); Ureña's rectangle in f32; Box and Muller's \
         Gaussian."
    )
}

fn of_warps(parameters: Vec<f64>, methods: Vec<Method>) -> Sweep {
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

/// Share of warps that fail, with the numbers that `usual` and `ours` give for each parameter.
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
