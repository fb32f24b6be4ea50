//! [`z_test`]: whether noise explains the difference of two images.

use glam::UVec2;

use super::CompareError;
use super::errors::{check, place};
use crate::image::Image;

/// Result of [`z_test`]. z is the difference of two values over its standard error.
#[derive(Clone, Debug, PartialEq)]
pub struct ZTest {
    /// Number of tests: one for each band of each pixel with a finite variance above zero.
    pub tested: usize,
    /// Number of tests whose z exceeds `limit`.
    pub failed: usize,
    /// Critical value of z at the significance 0.01 for all tests together (Šidák's correction): if two images differ by
    /// noise alone, none exceeds it in 99 of 100 cases.
    pub limit: f64,
    /// The largest z, and its pixel.
    pub largest: (f64, UVec2),
    /// The mean of z². Noise alone gives 1.
    pub mean_square: f64,
}

/// Tests each band of each pixel, by the variances stored in the images. `None` if neither image has any.
///
/// # Errors
/// As [`Errors::between`](super::Errors::between).
pub fn z_test(image: &Image, reference: &Image) -> Result<Option<ZTest>, CompareError> {
    check(image, reference)?;
    if image.variance.is_none() && reference.variance.is_none() {
        return Ok(None);
    }
    let variance = |image: &Image, index: usize| {
        image.variance.as_ref().map_or([0.0; 3], |variance| variance[index].to_array())
    };
    let mut z = Vec::new();
    for index in 0..image.pixels.len() {
        let bands =
            image.pixels[index].to_array().into_iter().zip(reference.pixels[index].to_array());
        let variances = variance(image, index).into_iter().zip(variance(reference, index));
        for ((a, b), (va, vb)) in bands.zip(variances) {
            let [a, b, va, vb] = [a, b, va, vb].map(f64::from);
            // Rounding of both values to f32.
            let rounding = (4e-6 * a.abs().max(b.abs())).powi(2);
            if va + vb > 0.0 && va + vb < f64::INFINITY {
                z.push(((a - b).abs() / (va + vb + rounding).sqrt(), index));
            }
        }
    }
    let limit = sidak(z.len());
    let largest =
        z.iter().copied().fold((0.0, 0), |worst, one| if one.0 > worst.0 { one } else { worst });
    Ok(Some(ZTest {
        tested: z.len(),
        failed: z.iter().filter(|(z, _)| *z > limit).count(),
        limit,
        largest: (largest.0, place(largest.1, image.size)),
        mean_square: z.iter().map(|(z, _)| z * z).sum::<f64>() / z.len().max(1) as f64,
    }))
}

/// Two-sided critical value of z at the significance 0.01 over this many independent tests: by bisection of the normal
/// distribution's tail, φ(z)/z (1 - 1/z² + 3/z⁴) (Abramowitz and Stegun 26.2.12), within 1 % from z = 3 on.
fn sidak(tests: usize) -> f64 {
    let probability = 1.0 - 0.99_f64.powf(1.0 / tests.max(1) as f64);
    let tail = |z: f64| {
        let density = (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
        2.0 * density / z * (1.0 - 1.0 / (z * z) + 3.0 / z.powi(4))
    };
    let (mut low, mut high) = (2.0, 12.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if tail(middle) > probability { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
