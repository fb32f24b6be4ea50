//! [`Filter`]: how much the light around a pixel counts for it.

mod blackman_harris;
mod boxed;
mod gaussian;
mod tent;

use glam::Vec2;

use crate::params::{Fault, Key, Kind, Table};

/// How a kind of filter is read.
pub type ReadFilter = fn(&Table) -> Result<Filter, Fault>;

/// All kinds of filters; the first one is the default.
pub static FILTERS: &[Kind<ReadFilter>] =
    &[boxed::KIND, tent::KIND, gaussian::KIND, blackman_harris::KIND];

/// The key for a filter's radius, with the radius that the filter has by default.
const fn radius_key(default: f32) -> Key<f32> {
    Key::new("filter_radius", "where the filter ends on each axis")
        .in_unit("pixels")
        .above(0.0)
        .at_most(Filter::LARGEST_RADIUS as f64)
        .default(default)
}

/// Why a filter cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FilterError {
    /// A filter covers something, and no more than [`Filter::LARGEST_RADIUS`].
    #[error("the filter's radius is {0}: it has to be above 0 and at most 16 pixels")]
    Radius(f32),
    /// A bell has a width.
    #[error("the filter's sigma is {0}: it has to be finite and above 0")]
    Sigma(f32),
}

/// A reconstruction filter about the middle of a pixel (PBRT 3rd edition, section 7.8): a product of the same
/// function of x and of y, which is symmetric, never negative, and falls from the middle to the radius.
/// Lengths are in pixels.
///
/// Samples are drawn in proportion to it, and all count the same (Ernst, Stamminger and Greiner 2006,
/// "Filter Importance Sampling"): so each belongs to one pixel, and tiles know nothing of each other.
/// [`FilterSampler`](super::FilterSampler) draws them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Filter {
    /// The pixel itself, and nothing around it.
    #[default]
    Box,
    /// A straight line down to zero.
    Tent {
        /// Where it ends on each axis.
        radius: f32,
    },
    /// A Gaussian, less its value at the radius.
    Gaussian {
        /// Where it ends on each axis.
        radius: f32,
        /// Standard deviation of the whole Gaussian.
        sigma: f32,
    },
    /// The window of Blackman and Harris with four terms (Harris 1978, "On the use of windows for harmonic
    /// analysis with the discrete Fourier transform", section V.H).
    BlackmanHarris {
        /// Where it ends on each axis.
        radius: f32,
    },
}

impl Filter {
    /// The largest radius, in pixels.
    pub const LARGEST_RADIUS: f32 = 16.0;

    /// Where the filter ends on each axis; half a pixel for the box.
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
            Self::Box => boxed::KIND.name,
            Self::Tent { .. } => tent::KIND.name,
            Self::Gaussian { .. } => gaussian::KIND.name,
            Self::BlackmanHarris { .. } => blackman_harris::KIND.name,
        }
    }

    /// Whether it can be used.
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

    /// The filter's value at this offset from the middle of the pixel; it is not normalised.
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
            Self::Tent { .. } => tent::profile(x, radius),
            Self::Gaussian { sigma, .. } => gaussian::profile(x, radius, f64::from(sigma)),
            Self::BlackmanHarris { .. } => blackman_harris::profile(x, radius),
        }
    }
}
