//! [`FILTERS`]: how the kinds of [`Filter`] are read.

use super::filter::Filter;
use crate::params::{Fault, Key, Kind, Table};

/// How a kind of filter is read.
pub type ReadFilter = fn(&Table) -> Result<Filter, Fault>;

/// All kinds of filters; the first one is the default.
pub static FILTERS: &[Kind<ReadFilter>] = &[
    Kind {
        name: Filter::Box.name(),
        meaning: "The pixel itself",
        keys: &[],
        read: |_| Ok(Filter::Box),
    },
    Kind {
        name: Filter::tent().name(),
        meaning: "A straight line down to zero",
        keys: &[&TENT_RADIUS],
        read: |table| Ok(Filter::Tent { radius: table.get(&TENT_RADIUS)? }),
    },
    Kind {
        name: Filter::gaussian().name(),
        meaning: "A Gaussian, less its value at the radius",
        keys: &[&GAUSSIAN_RADIUS, &SIGMA],
        read: |table| {
            Ok(Filter::Gaussian { radius: table.get(&GAUSSIAN_RADIUS)?, sigma: table.get(&SIGMA)? })
        },
    },
    Kind {
        name: Filter::blackman_harris().name(),
        meaning: "The window of Blackman and Harris with four terms",
        keys: &[&WINDOW_RADIUS],
        read: |table| Ok(Filter::BlackmanHarris { radius: table.get(&WINDOW_RADIUS)? }),
    },
];

const TENT_RADIUS: Key<f32> = radius_key(Filter::tent());
const GAUSSIAN_RADIUS: Key<f32> = radius_key(Filter::gaussian());
const WINDOW_RADIUS: Key<f32> = radius_key(Filter::blackman_harris());
const SIGMA: Key<f32> = Key::new("filter_sigma", "standard deviation of the whole Gaussian")
    .in_unit("pixels")
    .above(0.0)
    .default(Filter::GAUSSIAN_SIGMA);

/// The key for a filter's radius, with the radius that the filter has by default.
const fn radius_key(default: Filter) -> Key<f32> {
    Key::new("filter_radius", "where the filter ends on each axis")
        .in_unit("pixels")
        .above(0.0)
        .at_most(Filter::LARGEST_RADIUS as f64)
        .default(default.radius())
}
