//! `sample_f` draws what `pdf` says, and returns what `f` and `pdf` say.

use lobe::bxdf::{Bsdf, LambertianReflection, Lobe};
use lobe::geometry::Frame;
use lobe::glam::Vec3;

use super::{COLOR, VIEWS, lobes, view};
use crate::common::Rng;
use crate::common::lobes::{BothSides, Scatters, Through};
use crate::common::sphere::sphere_cells;
use crate::common::stats::assert_fits;

const SAMPLES: u64 = 1_000_000;
/// Eleven lobes and four mixtures, from six directions each: one family.
const RUNS: usize = 15 * VIEWS.len();

/// One lobe from one direction: the density, its integral, and the values that come with samples.
fn assert_samples(lobe: &dyn Scatters, wo: Vec3, test: u64, what: &str) {
    let cells = sphere_cells();
    let expected: Vec<f64> =
        (0..cells.count()).map(|c| cells.integrate(c, |wi| lobe.pdf(wo, wi).into())).collect();
    let integral: f64 = expected.iter().sum();
    assert!((integral - 1.0).abs() < 1e-3, "{what}: the pdf integrates to {integral}");

    let mut observed = vec![0; cells.count()];
    let (mut rng, mut missed) = (Rng::new(test, 0), 0);
    for trial in 0..SAMPLES {
        let (uc, u) = (rng.f32(), rng.square());
        // The border of the square gives directions along the surface, which have no density.
        let Some(sample) = lobe.sample_f(wo, uc, u) else {
            missed += 1;
            continue;
        };
        observed[cells.of(sample.wi)] += 1;
        if trial % 16 == 0 {
            let (f, pdf) = (lobe.f(wo, sample.wi).to_array(), lobe.pdf(wo, sample.wi));
            // 1e-6 is what the way to the world and back does to a grazing direction.
            let close = |a: f32, b: f32| (a - b).abs() <= 1e-3 * a.abs().max(b.abs()) + 1e-6;
            assert!(
                close(sample.pdf, pdf),
                "{what}: pdf {} of {uc}, {u}, but pdf() is {pdf}",
                sample.pdf
            );
            for (of_sample, f) in sample.f.to_array().into_iter().zip(f) {
                assert!(close(of_sample, f), "{what}: f {of_sample} of {uc}, {u}, but f() is {f}");
            }
        }
    }
    assert!(missed < 10, "{what}: no direction for {missed} samples");
    let expected: Vec<f64> = expected.iter().map(|e| e / integral * SAMPLES as f64).collect();
    assert_fits(&observed, &expected, RUNS, what);
}

/// Caught: a default `sample_f` that ignores the side of `wo`; a default `pdf` without the side; the
/// value of `ScaledBxDF`'s sample left unscaled.
#[test]
fn one_lobe() {
    for (number, (name, lobe)) in lobes().iter().enumerate() {
        for (direction, cos) in VIEWS.into_iter().enumerate() {
            let test = 100 + (number * VIEWS.len() + direction) as u64;
            assert_samples(&&**lobe, view(cos), test, &format!("{name}, cos {cos}"));
        }
    }
}

/// Caught: u.x used for the choice of a lobe and, not stretched again, for its direction; the pdf of
/// the chosen lobe alone; the sum of densities instead of their mean; `f` of the chosen lobe alone.
#[test]
fn mixtures() {
    let lobes = lobes();
    let n = Vec3::new(0.36, -0.48, -0.8);
    for (run, first) in [(0, 9), (1, 8), (2, 3)] {
        let mut bsdf = Bsdf::new(Frame::from_normal(n), n);
        for (_, lobe) in &lobes[first..] {
            assert!(bsdf.add(Lobe::Custom(&**lobe)));
        }
        for (direction, cos) in VIEWS.into_iter().enumerate() {
            let test = 200 + (run * VIEWS.len() + direction) as u64;
            let what = format!("{} lobes, cos {cos}", lobes.len() - first);
            assert_samples(&bsdf, view(cos), test, &what);
        }
        assert_eq!(bsdf.rejected(), 0);
    }
}

/// A lobe with two events among others. Caught: `uc` used for the choice of a lobe and, not stretched again, for that of
/// its event.
#[test]
fn events_within_a_mixture() {
    let n = Vec3::new(0.36, -0.48, -0.8);
    let both = BothSides { reflects: 0.2, transmits: 0.5 };
    let through = Through(0.3);
    let mut bsdf = Bsdf::new(Frame::from_normal(n), n);
    bsdf.add(LambertianReflection::new(COLOR));
    bsdf.add(Lobe::Custom(&both));
    bsdf.add(Lobe::Custom(&through));
    for (direction, cos) in VIEWS.into_iter().enumerate() {
        let test = 200 + (3 * VIEWS.len() + direction) as u64;
        assert_samples(&bsdf, view(cos), test, &format!("two events among others, cos {cos}"));
    }
    assert_eq!(bsdf.rejected(), 0);
}
