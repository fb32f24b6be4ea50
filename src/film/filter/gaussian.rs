//! The Gaussian, less its value at the radius.

use super::{Filter, ReadFilter, radius_key};
use crate::params::{Key, Kind};

const RADIUS: Key<f32> = radius_key(1.5);
const SIGMA: Key<f32> = Key::new("filter_sigma", "standard deviation of the whole Gaussian")
    .in_unit("pixels")
    .above(0.0)
    .default(0.5);

/// `filter = "gaussian"`
pub(super) const KIND: Kind<ReadFilter> = Kind {
    name: "gaussian",
    meaning: "A Gaussian, less its value at the radius",
    keys: &[&RADIUS, &SIGMA],
    read: |table| Ok(Filter::Gaussian { radius: table.get(&RADIUS)?, sigma: table.get(&SIGMA)? }),
};

impl Filter {
    /// A Gaussian with sigma 0.5, cut off at radius 1.5.
    pub const fn gaussian() -> Self {
        Self::Gaussian { radius: RADIUS.default_value(), sigma: SIGMA.default_value() }
    }
}

/// The factor for one axis, at `x` from 0 to the radius.
pub(super) fn profile(x: f64, radius: f64, sigma: f64) -> f64 {
    // exp(-a) - exp(-b) without cancellation, however flat the Gaussian is.
    let exponent = |x: f64| 0.5 * (x / sigma).powi(2);
    let (a, b) = (exponent(x), exponent(radius));
    -(-a).exp() * (a - b).exp_m1()
}
