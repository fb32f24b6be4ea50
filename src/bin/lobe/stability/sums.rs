//! Means and variances of many samples.

use lobe::Spectrum;
use lobe::film::{Film, FilmContents, Variance};
use lobe::glam::UVec2;
use lobe::image::Window;

use super::rng::Rng;
use super::sweep::{Method, Sweep};
use super::tally::{half_decades, measured, relative_error};

/// Number of samples added together.
const BLOCK: usize = 1000;
/// Samples of [`means`] are integers over this.
const UNITS: f64 = (1 << 27) as f64;

/// A film of one pixel.
fn film(variance: Variance) -> Option<Film> {
    let contents = FilmContents { variance, first_hits: false };
    Film::new(UVec2::ONE, Window::full(UVec2::ONE), contents).ok()
}

/// The mean of up to 1e8 samples.
pub fn means(effort: f64) -> Sweep {
    let parameters = half_decades(1, 8);
    let most = (1e8 * effort).clamp(1e5, 1e8);
    let mut methods: Vec<Method> =
        [("running sum in f32", false), ("running mean in f32", false), ("Film (ours)", true)]
            .map(|(name, is_ours)| Method { name, is_ours, values: Vec::new() })
            .into();
    let mut rng = Rng::new(0);
    let (mut sum, mut mean, mut film) = (0.0_f32, 0.0_f32, film(Variance::None));
    let (mut taken, mut exact) = (0_u64, 0_u64);
    let mut block = Vec::with_capacity(BLOCK);
    for &n in &parameters {
        if n > most {
            methods.iter_mut().for_each(|method| method.values.push(f64::NAN));
            continue;
        }
        while taken < n as u64 {
            block.clear();
            for _ in 0..BLOCK.min((n as u64 - taken) as usize) {
                // Multiples of 2⁻²⁷ with 24 bits, whose exact sum is the truth.
                let bits = ((0.099 + 0.002 * rng.unit()) * UNITS) as u32;
                let x = bits as f32 / UNITS as f32;
                taken += 1;
                exact += u64::from(bits);
                sum += x;
                mean += (x - mean) / taken as f32;
                block.push(Spectrum::splat(x));
            }
            if let Some(film) = &mut film {
                film.add_samples(UVec2::ZERO, 0, &block);
            }
        }
        let truth = exact as f64 / UNITS / n;
        let ours = film.as_ref().map_or(f64::NAN, |film| first(&film.develop().color));
        let found = [f64::from(sum) / n, f64::from(mean), ours];
        for (method, found) in methods.iter_mut().zip(found) {
            method.values.push(relative_error(found, truth));
        }
    }
    Sweep {
        name: "sums-mean",
        title: "Error of a pixel's mean, by the number of samples",
        about: "Values around 0.1, spread by 1 % to both sides, such as a wall in even light gives; whole multiples \
                of 2^-27, so that truth is their sum as integers. Common methods: a sum in f32, which rounds similar values \
                in the same direction each time and stagnates in the end; and a mean in f32, updated by \
                (x - mean) / n. Ours is a film of one pixel; its error is the rounding of the mean to f32."
            .to_owned(),
        parameter: "samples",
        log_parameter: true,
        measure: "relative error of the mean",
        methods,
        fails_from: 1e-3,
        bounds: vec![6.1e-8; parameters.len()],
        parameters,
    }
}

/// The variance of samples with a small standard deviation relative to their mean.
pub fn variances(effort: f64) -> Sweep {
    let parameters = half_decades(0, 6);
    let n = ((1e5 * effort) as u32).max(1000);
    let named = [
        ("E[x²] - E[x]² in f32", false),
        ("E[x²] - E[x]² in f64", false),
        ("Welford in f32", false),
        ("Film (ours)", true),
    ];
    let methods = measured(&parameters, named, |seed, ratio| {
        let samples = samples(&mut Rng::new(seed as u64), ratio, n);
        let truth = exact_variance(&samples);
        [naive_f32(&samples), naive_f64(&samples), welford(&samples), ours(&samples)]
            .map(|found| relative_error(found, truth))
    });
    Sweep {
        name: "sums-variance",
        title: "Error of a pixel's variance, by how little its samples differ",
        about: format!(
            "{n} samples around a mean of 1000, distributed evenly over ±√3 deviations and rounded to f32. Truth is the \
             variance of the rounded samples by sums of integers of 128 bits. Common methods: the difference of the mean \
             square and the squared mean, and Welford 1962 in f32. Ours is a film's variance of the mean, times n, \
             after Youngs and Cramer 1971 in f64. The difference in f64 fails too, from 300,000 on."
        ),
        parameter: "mean over standard deviation",
        log_parameter: true,
        measure: "relative error of the variance",
        methods,
        fails_from: 0.01,
        bounds: vec![6.2e-8; parameters.len()],
        parameters,
    }
}

/// Samples with mean 1000 and standard deviation 1000 / `ratio`.
fn samples(rng: &mut Rng, ratio: f64, n: u32) -> Vec<f32> {
    let half_width = 3.0_f64.sqrt() * 1000.0 / ratio;
    (0..n).map(|_| (1000.0 + half_width * (2.0 * rng.unit() - 1.0)) as f32).collect()
}

/// The exact variance, in integers: all samples are multiples of 2⁻³⁰.
fn exact_variance(samples: &[f32]) -> f64 {
    let unit = 2.0_f64.powi(-30);
    let whole = |x: &f32| (f64::from(*x) / unit).round() as i128;
    let n = samples.len() as i128;
    let sum: i128 = samples.iter().map(whole).sum();
    // Σ (n x - Σ x)² = n (n Σ x² - (Σ x)²).
    let squares: i128 = samples.iter().map(|x| whole(x).pow(2)).sum();
    (n * squares - sum * sum) as f64 * unit * unit / (n * (n - 1)) as f64
}

fn naive_f32(samples: &[f32]) -> f64 {
    let (mut sum, mut squares) = (0.0_f32, 0.0_f32);
    for x in samples {
        sum += x;
        squares += x * x;
    }
    let n = samples.len() as f32;
    let (mean, mean_square) = (sum / n, squares / n);
    f64::from((mean_square - mean * mean) * (n / (n - 1.0)))
}

fn naive_f64(samples: &[f32]) -> f64 {
    let (mut sum, mut squares) = (0.0, 0.0);
    for &x in samples {
        let x = f64::from(x);
        sum += x;
        squares += x * x;
    }
    let n = samples.len() as f64;
    let (mean, mean_square) = (sum / n, squares / n);
    (mean_square - mean * mean) * (n / (n - 1.0))
}

/// Welford 1962, "Note on a Method for Calculating Corrected Sums of Squares and Products".
fn welford(samples: &[f32]) -> f64 {
    let (mut mean, mut squares) = (0.0_f32, 0.0_f32);
    for (i, x) in samples.iter().enumerate() {
        let difference = x - mean;
        mean += difference / (i + 1) as f32;
        squares += difference * (x - mean);
    }
    f64::from(squares / (samples.len() - 1) as f32)
}

fn ours(samples: &[f32]) -> f64 {
    let Some(mut film) = film(Variance::OfSamples) else { return f64::NAN };
    for &x in samples {
        film.add_sample(UVec2::ZERO, 0, Spectrum::splat(x));
    }
    film.develop().variance.map_or(f64::NAN, |of_mean| first(&of_mean) * samples.len() as f64)
}

/// First band of the only pixel.
fn first(values: &[Spectrum]) -> f64 {
    values.first().map_or(f64::NAN, |value| f64::from(value.to_array()[0]))
}
