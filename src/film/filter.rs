//! [`Filter`]: the weight of radiance around a pixel's centre.

use glam::Vec2;

/// Why a filter cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FilterError {
    /// The radius is not in `(0, LARGEST_RADIUS]`: see [`Filter::LARGEST_RADIUS`].
    #[error("the filter's radius is {0}: it has to be above 0 and at most 16 pixels")]
    Radius(f32),
    /// The standard deviation is not finite or not above 0.
    #[error("the filter's sigma is {0}: it has to be finite and above 0")]
    Sigma(f32),
}

/// A reconstruction filter around the centre of a pixel (PBRT 3rd edition, section 7.8). It is separable: the product of
/// the same function of x and of y, which is symmetric, never negative, and falls from the centre to the radius. Lengths
/// are in pixels.
///
/// Positions are drawn in proportion to the filter, and all samples have the same weight (Ernst, Stamminger and Greiner
/// 2006, "Filter Importance Sampling"). So a sample belongs to one pixel, and tiles do not overlap.
/// [`FilterSampler`](super::FilterSampler) draws them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Filter {
    /// Constant over the pixel, zero outside.
    #[default]
    Box,
    /// Falls linearly to zero.
    Tent {
        /// Half of its width on each axis.
        radius: f32,
    },
    /// A Gaussian minus its value at the radius, so that it ends without a step.
    Gaussian {
        /// Half of its width on each axis.
        radius: f32,
        /// Standard deviation of the untruncated Gaussian.
        sigma: f32,
    },
    /// The four-term Blackman-Harris window (Harris 1978, "On the use of windows for harmonic
    /// analysis with the discrete Fourier transform", section V.H).
    BlackmanHarris {
        /// Half of its width on each axis.
        radius: f32,
    },
}

impl Filter {
    /// The largest radius, in pixels.
    pub const LARGEST_RADIUS: f32 = 16.0;

    pub(super) const GAUSSIAN_SIGMA: f32 = 0.5;

    /// A tent that reaches the centres of the neighbouring pixels.
    pub const fn tent() -> Self {
        Self::Tent { radius: 1.0 }
    }

    /// A Gaussian with sigma 0.5 and radius 1.5.
    pub const fn gaussian() -> Self {
        Self::Gaussian { radius: 1.5, sigma: Self::GAUSSIAN_SIGMA }
    }

    /// A Blackman-Harris window with radius 1.5.
    pub const fn blackman_harris() -> Self {
        Self::BlackmanHarris { radius: 1.5 }
    }

    /// Half of the filter's width on each axis, in pixels; 0.5 for the box.
    pub const fn radius(&self) -> f32 {
        match *self {
            Self::Box => 0.5,
            Self::Tent { radius }
            | Self::Gaussian { radius, .. }
            | Self::BlackmanHarris { radius } => radius,
        }
    }

    /// Its name in scene files.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Tent { .. } => "tent",
            Self::Gaussian { .. } => "gaussian",
            Self::BlackmanHarris { .. } => "blackman-harris",
        }
    }

    /// Checks the parameters.
    ///
    /// # Errors
    /// If the radius is not above 0 or is above [`LARGEST_RADIUS`](Self::LARGEST_RADIUS), or sigma is not
    /// above 0 or not finite.
    pub fn check(&self) -> Result<(), FilterError> {
        let radius = self.radius();
        if !(radius > 0.0 && radius <= Self::LARGEST_RADIUS) {
            return Err(FilterError::Radius(radius));
        }
        match *self {
            Self::Gaussian { sigma, .. } if !(sigma > 0.0 && sigma.is_finite()) => {
                Err(FilterError::Sigma(sigma))
            }
            _ => Ok(()),
        }
    }

    /// The filter's value at this offset from the pixel's centre. It is not normalised.
    pub fn evaluate(&self, offset: Vec2) -> f32 {
        (self.profile(f64::from(offset.x)) * self.profile(f64::from(offset.y))) as f32
    }

    /// The factor for one axis.
    pub(super) fn profile(&self, x: f64) -> f64 {
        let radius = f64::from(self.radius());
        let x = x.abs();
        if x > radius {
            return 0.0;
        }
        match *self {
            Self::Box => 1.0,
            Self::Tent { .. } => 1.0 - x / radius,
            Self::Gaussian { sigma, .. } => {
                // exp(-a) - exp(-b) without cancellation, however flat the Gaussian is.
                let exponent = |x: f64| 0.5 * (x / f64::from(sigma)).powi(2);
                let (a, b) = (exponent(x), exponent(radius));
                -(-a).exp() * (a - b).exp_m1()
            }
            Self::BlackmanHarris { .. } => {
                let cosine = |k: f64| (k * std::f64::consts::PI * x / radius).cos();
                0.35875 + 0.48829 * cosine(1.0) + 0.14128 * cosine(2.0) + 0.01168 * cosine(3.0)
            }
        }
    }
}
