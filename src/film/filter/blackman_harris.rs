//! The window of Blackman and Harris.

use super::{Filter, ReadFilter, radius_key};
use crate::params::{Key, Kind};

const RADIUS: Key<f32> = radius_key(1.5);

/// `filter = "blackman-harris"`
pub(super) const KIND: Kind<ReadFilter> = Kind {
    name: "blackman-harris",
    meaning: "The window of Blackman and Harris with four terms",
    keys: &[&RADIUS],
    read: |table| Ok(Filter::BlackmanHarris { radius: table.get(&RADIUS)? }),
};

impl Filter {
    /// The window of Blackman and Harris with radius 1.5.
    pub const fn blackman_harris() -> Self {
        Self::BlackmanHarris { radius: RADIUS.default_value() }
    }
}

/// The factor for one axis, at `x` from 0 to the radius.
pub(super) fn profile(x: f64, radius: f64) -> f64 {
    let cosine = |k: f64| (k * std::f64::consts::PI * x / radius).cos();
    0.35875 + 0.48829 * cosine(1.0) + 0.14128 * cosine(2.0) + 0.01168 * cosine(3.0)
}
