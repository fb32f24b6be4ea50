//! Comparisons of images with each other and with known values, by the errors that their films state.

use lobe::image::Picture;
use lobe::scene::SceneBuilder;
use lobe::{RenderOptions, RenderSettings, View, render};

/// The picture of a scene, with the variance of each pixel.
pub fn picture(scene: SceneBuilder, view: &View, settings: &RenderSettings) -> Picture {
    let options = RenderOptions { layers: true, ..RenderOptions::default() };
    let rendered = render(&scene.build().unwrap(), view, settings, &options).unwrap();
    assert_eq!((rendered.non_finite, rendered.counters.rejected), (0, 0));
    rendered.picture
}

/// Every band of every pixel: mean and variance of that mean.
pub fn bands(picture: &Picture) -> Vec<(f64, f64)> {
    let variance = picture.variance.as_ref().expect("no variance");
    let values = picture.color.iter().zip(variance).flat_map(|(c, v)| {
        c.to_array().into_iter().zip(v.to_array()).map(|(c, v)| (c.into(), v.into()))
    });
    values.collect()
}

/// Asserts that the mean of the whole picture is `expected`, within 5 of the standard errors that the
/// film states, or within the rounding of f32.
#[track_caller]
pub fn assert_mean(picture: &Picture, expected: f64, what: &str) {
    let bands = bands(picture);
    let count = bands.len() as f64;
    let mean = bands.iter().map(|b| b.0).sum::<f64>() / count;
    let error = band_errors(&bands) / count;
    let off = (mean - expected).abs();
    assert!(
        off <= 5.0 * error + 2e-6 * expected,
        "{what}: {mean}, expected {expected}, off by {} standard errors of {error}",
        off / error
    );
}

/// Asserts that two pictures differ by noise only: at least 99.75 % of bands of pixels pass a Z-test at
/// significance 0.01 with Šidák's correction (as Mitsuba's test_renders has it), and the means agree within
/// 4 standard errors.
#[track_caller]
pub fn assert_alike(a: &[(f64, f64)], b: &[(f64, f64)], what: &str) {
    assert_eq!(a.len(), b.len());
    let limit = normal_quantile_two_sided(1.0 - 0.99_f64.powf(1.0 / a.len() as f64));
    // f32 holds a band to 6e-8 of itself, and its sums pass through a few roundings.
    let z = |(a, b): (&(f64, f64), &(f64, f64))| {
        (a.0 - b.0) / (a.1 + b.1 + (2e-6 * a.0.max(b.0)).powi(2)).sqrt().max(1e-30)
    };
    let passed = a.iter().zip(b).filter(|&pair| z(pair).abs() <= limit).count();
    let share = passed as f64 / a.len() as f64;
    assert!(share >= 0.9975, "{what}: only {share} of bands pass at {limit}");
    let sum =
        |f: fn(&(f64, f64)) -> f64| a.iter().map(f).sum::<f64>() - b.iter().map(f).sum::<f64>();
    let both: Vec<_> = a.iter().zip(b).map(|(a, b)| (0.0, a.1 + b.1)).collect();
    let scale: f64 = a.iter().map(|band| band.0).sum();
    let off = sum(|band| band.0).abs() / (band_errors(&both) + 1e-6 * scale);
    assert!(off <= 4.0, "{what}: the means differ by {off} standard errors");
}

/// The standard error of the sum of all bands. Pixels are independent of each other, but the three bands of a pixel are
/// not: their errors may add up.
fn band_errors(bands: &[(f64, f64)]) -> f64 {
    let of_band = |band| bands.iter().skip(band).step_by(3).map(|b| b.1).sum::<f64>().sqrt();
    (0..3).map(of_band).sum()
}

/// The z beyond which, on either side, a normal variable lies with this probability, by bisection of a
/// bound for the tail (Abramowitz and Stegun 26.2.12: φ(z)/z (1 - 1/z² + 3/z⁴)), which is within 1 % of
/// it from z = 3 on.
fn normal_quantile_two_sided(probability: f64) -> f64 {
    let tail = |z: f64| {
        let density = (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
        2.0 * density / z * (1.0 - 1.0 / (z * z) + 3.0 / z.powi(4))
    };
    let (mut low, mut high) = (3.0, 12.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if tail(middle) > probability { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
