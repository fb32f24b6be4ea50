//! [`FilterError`], and the radius, the parameter that all filters have.

use crate::params::Key;

/// The largest radius of a filter, in pixels.
pub const MAX_FILTER_RADIUS: f32 = 16.0;

/// Why a filter cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FilterError {
    /// The radius is not in `(0, MAX_FILTER_RADIUS]`.
    #[error(
        "the filter's radius is {0}: it has to be above 0 and at most {most} pixels",
        most = MAX_FILTER_RADIUS
    )]
    Radius(f32),
    /// The standard deviation is not finite or not above 0.
    #[error("the filter's sigma is {0}: it has to be finite and above 0")]
    Sigma(f32),
    /// The profile is zero at the centre, rises somewhere, or has a value that is negative or not a finite `f32`.
    #[error(
        "the filter's profile is {value} at {x} pixels from the centre: \
         it has to be finite and above 0 at the centre, and fall from there, but not below 0"
    )]
    Profile {
        /// Distance from the centre, in pixels.
        x: f64,
        /// The profile there.
        value: f64,
    },
}

/// The key of a filter's radius.
pub(super) const fn radius_key(default: f32) -> Key<f32> {
    RADIUS.default(default)
}

const RADIUS: Key<f32> = Key::new("filter_radius", "where the filter ends on each axis")
    .in_unit("pixels")
    .above(0.0)
    .at_most(MAX_FILTER_RADIUS as f64);

/// Checks the range of a radius.
pub(super) fn check_radius(radius: f32) -> Result<(), FilterError> {
    if RADIUS.limits().contains_f32(radius) { Ok(()) } else { Err(FilterError::Radius(radius)) }
}
