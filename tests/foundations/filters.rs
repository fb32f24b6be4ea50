//! Filters: places in proportion to them. Truth is each filter's formula, written once more in f64.

use std::f64::consts::PI;

use lobe::film::{Filter, FilterSampler};
use lobe::glam::Vec2;

use crate::common::Rng;
use crate::common::stats::{assert_fits, assert_mean, mean};

/// Wide, narrow and extreme shapes.
const FILTERS: [Filter; 10] = [
    Filter::Box,
    Filter::tent(),
    Filter::gaussian(),
    Filter::blackman_harris(),
    Filter::Tent { radius: 16.0 },
    Filter::Gaussian { radius: 2.0, sigma: 0.5 },
    Filter::Gaussian { radius: 16.0, sigma: 0.1 },
    Filter::Gaussian { radius: 0.3, sigma: 1e20 },
    Filter::BlackmanHarris { radius: 4.0 },
    Filter::BlackmanHarris { radius: 1e-3 },
];

/// The factor for one axis.
fn profile(filter: Filter, x: f64) -> f64 {
    let square = |x: f32| f64::from(x).powi(2);
    match filter {
        Filter::Box => 1.0,
        Filter::Tent { radius } => 1.0 - x.abs() / f64::from(radius),
        // So wide a Gaussian is a parabola, up to a factor.
        Filter::Gaussian { radius, sigma: 1e20 } => square(radius) - x * x,
        Filter::Gaussian { radius, sigma } => {
            let value = |xx: f64| (-xx / (2.0 * square(sigma))).exp();
            value(x * x) - value(square(radius))
        }
        Filter::BlackmanHarris { radius } => {
            let w = PI * x / f64::from(radius);
            0.35875 + 0.48829 * w.cos() + 0.14128 * (2.0 * w).cos() + 0.01168 * (3.0 * w).cos()
        }
        _ => panic!("{filter:?} has no formula here"),
    }
}

/// The integral of x^power times the profile from `a` to `b`, by the midpoint rule.
fn moment(filter: Filter, power: i32, a: f64, b: f64, steps: usize) -> f64 {
    let step = (b - a) / steps as f64;
    let at = |i: usize| a + step * (i as f64 + 0.5);
    (0..steps).map(|i| at(i).powi(power) * profile(filter, at(i)) * step).sum()
}

/// Half width of the part of the filter that has all but a ten-thousandth of the samples.
fn extent(filter: Filter) -> f64 {
    match filter {
        Filter::Gaussian { radius, sigma } => f64::from(radius.min(6.5 * sigma)),
        _ => f64::from(filter.radius()),
    }
}

/// A million samples over 24 × 24 cells against the formula.
#[test]
fn places_are_in_proportion_to_the_filter() {
    const SIDE: usize = 24;
    const COUNT: u64 = 1_000_000;
    for (number, filter) in FILTERS.into_iter().enumerate() {
        let r = extent(filter);
        let sampler = FilterSampler::new(filter).unwrap();
        let mut rng = Rng::new(40, number as u64);
        let mut observed = vec![0; SIDE * SIDE];
        let cell = |x: f32| (((f64::from(x) / r + 1.0) / 2.0 * SIDE as f64) as usize).min(SIDE - 1);
        for _ in 0..COUNT {
            let p = sampler.sample(rng.square());
            observed[cell(p.y) * SIDE + cell(p.x)] += 1;
        }
        let total = moment(filter, 0, -r, r, 100_000);
        let border = |i: usize| (2.0 * i as f64 / SIDE as f64 - 1.0) * r;
        let share: Vec<_> =
            (0..SIDE).map(|i| moment(filter, 0, border(i), border(i + 1), 4000) / total).collect();
        let expected: Vec<_> =
            (0..SIDE * SIDE).map(|i| share[i / SIDE] * share[i % SIDE] * COUNT as f64).collect();
        assert_fits(&observed, &expected, FILTERS.len(), &format!("{filter:?}"));
    }
}

/// Mean and mean square on each axis.
#[test]
fn moments_are_the_filters() {
    for (number, filter) in FILTERS.into_iter().enumerate() {
        let r = extent(filter);
        let sampler = FilterSampler::new(filter).unwrap();
        let mut rng = Rng::new(41, number as u64);
        let places: Vec<_> = (0..1_000_000).map(|_| sampler.sample(rng.square())).collect();
        let square = moment(filter, 2, -r, r, 100_000) / moment(filter, 0, -r, r, 100_000);
        for axis in 0..2 {
            let x = || places.iter().map(|p| f64::from(p[axis]));
            for (values, truth) in [(mean(x()), 0.0), (mean(x().map(|x| x * x)), square)] {
                let runs = 4 * FILTERS.len();
                assert_mean(values.0, values.1, truth, runs, &format!("{filter:?}, axis {axis}"));
            }
        }
    }
}

/// At 4001 places u, the share of the filter that lies below the place is u.
#[test]
fn the_share_below_a_place_is_u() {
    for filter in FILTERS {
        let sampler = FilterSampler::new(filter).unwrap();
        let r = extent(filter);
        let total = moment(filter, 0, -r, r, 100_000);
        let (mut below, mut last, mut worst) = (0.0, -r, 0.0_f64);
        for i in 0..4001 {
            let u = (i as f32 + 0.5) / 4001.0;
            let x = f64::from(sampler.sample(Vec2::splat(u)).x);
            below += moment(filter, 0, last, x, 200) / total;
            last = x;
            worst = worst.max((below - f64::from(u)).abs());
        }
        let default = [Filter::gaussian(), Filter::blackman_harris()].contains(&filter);
        println!("{filter:?}: {worst:e}");
        assert!(worst < if default { 2e-6 } else { 5e-6 }, "{filter:?}: {worst:e}");
    }
}

/// In range at the ends, zero in the middle, and never decreasing: at 2¹⁶ neighbours from each of several
/// places and at a million places in order.
#[test]
fn places_never_decrease() {
    let ulp = 2.0_f32.powi(-24);
    for filter in FILTERS {
        let sampler = FilterSampler::new(filter).unwrap();
        let at = |u: f32| sampler.sample(Vec2::new(u, 0.5));
        let neighbours = [0.0, 0.1, 0.25, 0.499, 0.75, 0.9, 1.0 - 65_537.0 * ulp];
        let runs = neighbours.map(|start| (start, ulp)).into_iter().chain([(0.0, 1e-6)]);
        for (start, step) in runs {
            let mut last = -filter.radius();
            for i in 0..if step == ulp { 65_537 } else { 1_000_000 } {
                let p = at(start + i as f32 * step);
                assert!(p.x >= last && p.x <= filter.radius(), "{filter:?}: {p} after {last}");
                assert_eq!(p.y, 0.0);
                last = p.x;
            }
        }
        for u in [0.0, ulp, 0.5, 1.0 - ulp] {
            let place = sampler.place(Vec2::new(0.5, u));
            let expected = if filter == Filter::Box { u } else { at(u).x + 0.5 };
            assert_eq!(place.to_array().map(f32::to_bits), [0.5, expected].map(f32::to_bits));
        }
    }
}

#[test]
fn values_are_the_formulas() {
    let mut rng = Rng::new(42, 0);
    for filter in FILTERS {
        let value = |x: f64, y: f64| filter.evaluate(Vec2::new(x as f32, y as f32));
        let r = f64::from(filter.radius());
        let middle = profile(filter, 0.0).powi(2);
        for _ in 0..1000 {
            let [x, y] = [0; 2].map(|_| f64::from((r * (2.0 * rng.f64() - 1.0)) as f32));
            let share = profile(filter, x) * profile(filter, y) / middle;
            let found = f64::from(value(x, y)) / f64::from(value(0.0, 0.0)).max(1e-300);
            let flat = filter == Filter::Gaussian { radius: 0.3, sigma: 1e20 };
            assert!(flat || (found - share).abs() < 1e-6, "{filter:?} {x} {y}: {found}, {share}");
        }
        assert_eq!([value(1.01 * r, 0.0), value(0.0, -1.01 * r)], [0.0; 2]);
    }
}

#[test]
fn filters_without_sense_are_refused() {
    let radius = "the filter's radius is {}: it has to be above 0 and at most 16 pixels";
    let sigma = "the filter's sigma is {}: it has to be finite and above 0";
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY, 16.01] {
        for filter in [
            Filter::Tent { radius: bad },
            Filter::Gaussian { radius: bad, sigma: 1.0 },
            Filter::BlackmanHarris { radius: bad },
        ] {
            let error = FilterSampler::new(filter).unwrap_err().to_string();
            assert_eq!(error, radius.replace("{}", &bad.to_string()));
        }
    }
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let error = FilterSampler::new(Filter::Gaussian { radius: 1.0, sigma: bad }).unwrap_err();
        assert_eq!(error.to_string(), sigma.replace("{}", &bad.to_string()));
    }
    assert!(FILTERS.iter().all(|filter| filter.check().is_ok()));
}
