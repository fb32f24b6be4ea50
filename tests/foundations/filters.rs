//! Filters: places in proportion to them. Truth is each filter's formula, written once more in f64.

use std::f64::consts::PI;
use std::fmt::Debug;

use lobe::film::{
    BlackmanHarrisFilter, BoxFilter, Filter, FilterError, GaussianFilter, TentFilter,
};
use lobe::glam::Vec2;

use crate::common::Rng;
use crate::common::stats::{assert_fits, assert_mean, mean};
use crate::scenes::Parabola;

/// A filter with its truth.
struct Case {
    filter: Box<dyn Filter>,
    /// The formula for one axis, up to a factor.
    formula: Box<dyn Fn(f64) -> f64>,
    /// Half width of the part of the filter that has all but a ten-thousandth of the samples.
    extent: f64,
    /// How far the distribution may be from the filter's.
    bound: f64,
    /// Whether the values of the filter are too small for f32.
    is_tiny: bool,
}

fn case(filter: impl Filter + 'static, formula: impl Fn(f64) -> f64 + 'static) -> Case {
    let extent = f64::from(filter.radius());
    let (filter, formula) = (Box::new(filter), Box::new(formula));
    Case { filter, formula, extent, bound: 5e-6, is_tiny: false }
}

fn tent(filter: TentFilter) -> Case {
    case(filter, move |x| 1.0 - x.abs() / f64::from(filter.radius))
}

fn gaussian(filter: GaussianFilter) -> Case {
    let GaussianFilter { radius, sigma } = filter;
    let square = |x: f32| f64::from(x).powi(2);
    let value = move |xx: f64| (-xx / (2.0 * square(sigma))).exp();
    let formula = move |x: f64| value(x * x) - value(square(radius));
    Case { extent: f64::from(radius.min(6.5 * sigma)), ..case(filter, formula) }
}

fn blackman_harris(filter: BlackmanHarrisFilter) -> Case {
    case(filter, move |x| {
        let w = PI * x / f64::from(filter.radius);
        0.35875 + 0.48829 * w.cos() + 0.14128 * (2.0 * w).cos() + 0.01168 * (3.0 * w).cos()
    })
}

/// Wide, narrow and extreme shapes, and a filter of another crate.
fn cases() -> [Case; 11] {
    // So wide a Gaussian is a parabola, up to a factor.
    let flat = GaussianFilter { radius: 0.3, sigma: 1e20 };
    let parabola = move |x: f64| f64::from(flat.radius).powi(2) - x * x;
    [
        case(BoxFilter, |_| 1.0),
        tent(TentFilter::default()),
        Case { bound: 2e-6, ..gaussian(GaussianFilter::default()) },
        Case { bound: 2e-6, ..blackman_harris(BlackmanHarrisFilter::default()) },
        tent(TentFilter { radius: 16.0 }),
        gaussian(GaussianFilter { radius: 2.0, sigma: 0.5 }),
        gaussian(GaussianFilter { radius: 16.0, sigma: 0.1 }),
        Case { is_tiny: true, ..case(flat, parabola) },
        blackman_harris(BlackmanHarrisFilter { radius: 4.0 }),
        blackman_harris(BlackmanHarrisFilter { radius: 1e-3 }),
        case(Parabola, |x| 1.0 - 0.25 * x * x),
    ]
}

/// The integral of x^power times the profile from `a` to `b`, by the midpoint rule.
fn moment(formula: &dyn Fn(f64) -> f64, power: i32, a: f64, b: f64, steps: usize) -> f64 {
    let step = (b - a) / steps as f64;
    let at = |i: usize| a + step * (i as f64 + 0.5);
    (0..steps).map(|i| at(i).powi(power) * formula(at(i)) * step).sum()
}

/// A million samples over 24 × 24 cells against the formula.
#[test]
fn places_are_in_proportion_to_the_filter() {
    const SIDE: usize = 24;
    const COUNT: u64 = 1_000_000;
    for (number, Case { filter, formula, extent: r, .. }) in cases().into_iter().enumerate() {
        let sampler = filter.prepare().unwrap();
        let mut rng = Rng::new(40, number as u64);
        let mut observed = vec![0; SIDE * SIDE];
        let cell = |x: f32| (((f64::from(x) / r + 1.0) / 2.0 * SIDE as f64) as usize).min(SIDE - 1);
        for _ in 0..COUNT {
            let p = sampler.sample(rng.square());
            observed[cell(p.y) * SIDE + cell(p.x)] += 1;
        }
        let total = moment(&formula, 0, -r, r, 100_000);
        let border = |i: usize| (2.0 * i as f64 / SIDE as f64 - 1.0) * r;
        let share: Vec<_> = (0..SIDE)
            .map(|i| moment(&formula, 0, border(i), border(i + 1), 4000) / total)
            .collect();
        let expected: Vec<_> =
            (0..SIDE * SIDE).map(|i| share[i / SIDE] * share[i % SIDE] * COUNT as f64).collect();
        assert_fits(&observed, &expected, cases().len(), &format!("{filter:?}"));
    }
}

/// Mean and mean square on each axis.
#[test]
fn moments_are_the_filters() {
    for (number, Case { filter, formula, extent: r, .. }) in cases().into_iter().enumerate() {
        let sampler = filter.prepare().unwrap();
        let mut rng = Rng::new(41, number as u64);
        let places: Vec<_> = (0..1_000_000).map(|_| sampler.sample(rng.square())).collect();
        let square = moment(&formula, 2, -r, r, 100_000) / moment(&formula, 0, -r, r, 100_000);
        for axis in 0..2 {
            let x = || places.iter().map(|p| f64::from(p[axis]));
            for (values, truth) in [(mean(x()), 0.0), (mean(x().map(|x| x * x)), square)] {
                let runs = 4 * cases().len();
                assert_mean(values.0, values.1, truth, runs, &format!("{filter:?}, axis {axis}"));
            }
        }
    }
}

/// At 4001 places u, the share of the filter that lies below the place is u.
#[test]
fn the_share_below_a_place_is_u() {
    for Case { filter, formula, extent: r, bound, .. } in cases() {
        let sampler = filter.prepare().unwrap();
        let total = moment(&formula, 0, -r, r, 100_000);
        let (mut below, mut last, mut worst) = (0.0, -r, 0.0_f64);
        for i in 0..4001 {
            let u = (i as f32 + 0.5) / 4001.0;
            let x = f64::from(sampler.sample(Vec2::splat(u)).x);
            below += moment(&formula, 0, last, x, 200) / total;
            last = x;
            worst = worst.max((below - f64::from(u)).abs());
        }
        println!("{filter:?}: {worst:e}");
        assert!(worst < bound, "{filter:?}: {worst:e}");
    }
}

/// In range at the ends, zero in the middle, and never decreasing: at 2¹⁶ neighbours from each of several
/// places and at a million places in order. Seen to fail with a box whose u is not returned as it is.
#[test]
fn places_never_decrease() {
    let ulp = 2.0_f32.powi(-24);
    for Case { filter, .. } in cases() {
        let sampler = filter.prepare().unwrap();
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
        // 1e-9 is lost where a half is taken and given back.
        for u in [0.0, 1e-9, ulp, 0.5, 1.0 - ulp] {
            let place = sampler.sample_in_pixel(Vec2::new(0.5, u));
            let expected = if filter.describe() == "box" { u } else { at(u).x + 0.5 };
            assert_eq!(place.to_array().map(f32::to_bits), [0.5, expected].map(f32::to_bits));
        }
    }
}

/// Seen to fail with a filter that does not end at its radius.
#[test]
fn values_are_the_formulas() {
    let mut rng = Rng::new(42, 0);
    for Case { filter, formula, is_tiny, .. } in cases() {
        let value = |x: f64, y: f64| filter.evaluate(Vec2::new(x as f32, y as f32));
        let r = f64::from(filter.radius());
        let middle = formula(0.0).powi(2);
        for _ in 0..1000 {
            let [x, y] = [0; 2].map(|_| f64::from((r * (2.0 * rng.f64() - 1.0)) as f32));
            let share = formula(x) * formula(y) / middle;
            let found = f64::from(value(x, y)) / f64::from(value(0.0, 0.0)).max(1e-300);
            assert!(
                is_tiny || (found - share).abs() < 1e-6,
                "{filter:?} {x} {y}: {found}, {share}"
            );
        }
        assert_eq!([value(1.01 * r, 0.0), value(0.0, -1.01 * r)], [0.0; 2]);
    }
}

fn error(filter: &dyn Filter) -> String {
    filter.prepare().unwrap_err().to_string()
}

/// Seen to fail with the check of the radius left out of the trait, of the Gaussian and of the tent, and with an infinite
/// sigma let through.
#[test]
fn filters_without_sense_are_refused() {
    let radius = "the filter's radius is {}: it has to be above 0 and at most 16 pixels";
    let sigma = "the filter's sigma is {}: it has to be finite and above 0";
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY, 16.01] {
        let filters: [&dyn Filter; 4] = [
            &TentFilter { radius: bad },
            &GaussianFilter { radius: bad, sigma: 1.0 },
            &BlackmanHarrisFilter { radius: bad },
            &Foreign(bad, |_| 1.0),
        ];
        for filter in filters {
            let message = radius.replace("{}", &bad.to_string());
            assert_eq!(error(filter), message);
            assert_eq!(filter.check().unwrap_err().to_string(), message);
        }
    }
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let message = sigma.replace("{}", &bad.to_string());
        assert_eq!(error(&GaussianFilter { radius: 1.0, sigma: bad }), message);
    }
    assert!(cases().iter().all(|case| case.filter.check().is_ok()));
}

/// A filter of another crate with this radius and profile.
struct Foreign(f32, fn(f64) -> f64);

impl Debug for Foreign {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "foreign, radius {}", self.0)
    }
}

impl Filter for Foreign {
    fn radius(&self) -> f32 {
        self.0
    }

    fn profile(&self, x: f64) -> f64 {
        self.1(x)
    }
}

/// Profiles that cannot be sampled: the error tells where. Seen to fail with each condition left out.
#[test]
fn profiles_of_other_crates_are_checked() {
    let refused = |profile| match Foreign(2.0, profile).prepare() {
        Err(FilterError::Profile { x, value }) => (x, value),
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(|_| 0.0), (0.0, 0.0));
    assert_eq!(refused(|_| -1.0), (0.0, -1.0));
    assert_eq!(refused(|_| f64::INFINITY), (0.0, f64::INFINITY));
    assert_eq!(refused(|_| 1e39), (0.0, 1e39));
    assert_eq!(refused(|x| if x < 1.0 { 1.0 } else { 2.0 }), (1.0, 2.0));
    assert_eq!(refused(|x| if x < 2.0 { 1.0 } else { -1e-9 }), (2.0, -1e-9));
    let (x, value) = refused(|x| if x < 0.5 { 1.0 } else { f64::NAN });
    assert!(x == 0.5 && value.is_nan(), "{x}, {value}");
    assert_eq!(
        error(&Foreign(2.0, |x| 1.0 - x)),
        "the filter's profile is -0.00390625 at 1.00390625 pixels from the centre: \
         it has to be finite and above 0 at the centre, and fall from there, but not below 0"
    );
    // Equal values, and zeros before the radius, are no mistake.
    let step = Foreign(2.0, |x| if x < 1.0 { 1.0 } else { 0.0 });
    assert_eq!(step.describe(), "foreign, radius 2");
    let step = step.prepare().unwrap();
    for u in [0.0, f32::EPSILON, 0.3, 0.5, 1.0 - f32::EPSILON] {
        let p = step.sample(Vec2::splat(u));
        assert!(p.abs().max_element() <= 2.0, "{u}: {p}");
    }
}
