//! [`z_test`]: whether noise explains the difference of two images.

use glam::UVec2;

use super::errors::{check, place};
use super::{CompareError, StudentT};
use crate::image::Image;

/// Result of [`z_test`].
///
/// t is the difference of two values over its standard error. z is what a normal variable exceeds as rarely as t is
/// exceeded, if noise alone makes the values differ: by Student's t distribution, with the degrees of freedom of both
/// variances by Welch and Satterthwaite. With infinitely many, z and t are equal.
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

/// Tests each band of each pixel, by the variances stored in the images and their degrees of freedom. Where these are
/// not known, they are taken to be infinite. `None` if neither image has variances.
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
    // The squared variance of a variance is its square over half the degrees of freedom.
    let per_degree = [image, reference]
        .map(|image| image.degrees_of_freedom.map_or(0.0, |n| 1.0 / f64::from(n)));
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
                let t = (a - b).abs() / (va + vb + rounding).sqrt();
                // Welch 1947, "The generalization of `Student's' problem when several different population variances
                // are involved".
                let [share_a, share_b] = [va, vb].map(|v| v / (va + vb));
                let inverse = share_a.powi(2) * per_degree[0] + share_b.powi(2) * per_degree[1];
                let distribution = StudentT { degrees_of_freedom: 1.0 / inverse };
                z.push((distribution.about_normal_deviate(t), distribution, t, index));
            }
        }
    }
    let limit = StudentT::NORMAL.two_sided_quantile(sidak(z.len()));
    // Exactly where it matters: the approximation is within 13 % there.
    for (z, distribution, t, _) in z.iter_mut().filter(|(z, ..)| *z > 0.8 * limit) {
        *z = distribution.normal_deviate(*t);
    }
    let z = z.into_iter().map(|(z, _, _, index)| (z, index)).collect::<Vec<_>>();
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

/// The significance of each of this many independent tests that gives all of them together 0.01.
fn sidak(tests: usize) -> f64 {
    -(0.99_f64.ln() / tests.max(1) as f64).exp_m1()
}
