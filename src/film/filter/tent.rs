//! The tent: a straight line down to zero.

use super::{Filter, ReadFilter, radius_key};
use crate::params::{Key, Kind};

const RADIUS: Key<f32> = radius_key(1.0);

/// `filter = "tent"`
pub(super) const KIND: Kind<ReadFilter> = Kind {
    name: "box",
    meaning: "A straight line down to zero",
    keys: &[&RADIUS],
    read: |table| Ok(Filter::Tent { radius: table.get(&RADIUS)? }),
};

impl Filter {
    /// A tent that reaches to the middles of the next pixels.
    pub const fn tent() -> Self {
        Self::Tent { radius: RADIUS.default_value() }
    }
}

/// The factor for one axis, at `x` from 0 to the radius.
pub(super) fn profile(x: f64, radius: f64) -> f64 {
    1.0 - x / radius
}
