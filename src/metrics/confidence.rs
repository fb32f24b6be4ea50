//! [`half_widths`]: confidence intervals of an image's values.

use super::StudentT;
use crate::image::Image;
use crate::spectrum::Spectrum;

/// Half the width of the 95 % confidence interval around each value: the standard error times the quantile of Student's t
/// distribution with the image's degrees of freedom, or of the normal distribution if these are not known. `None` without
/// variances.
pub fn half_widths(image: &Image) -> Option<Vec<Spectrum>> {
    let quantile = StudentT::of(image.degrees_of_freedom).two_sided_quantile(0.05) as f32;
    let variance = image.variance.as_ref()?;
    Some(variance.iter().map(|v| v.to_array().map(|band| quantile * band.sqrt()).into()).collect())
}
