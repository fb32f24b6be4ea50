//! [`BoxFilter`]: the pixel itself.

use std::sync::Arc;

use super::parameters::FilterError;
use super::sampler::FilterSampler;
use super::traits::{Filter, ReadFilter};
use crate::params::{Fault, Kind, Table};

/// Constant over the pixel, zero outside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BoxFilter;

impl Filter for BoxFilter {
    fn radius(&self) -> f32 {
        0.5
    }

    fn profile(&self, _x: f64) -> f64 {
        1.0
    }

    /// Samples are uniform in the pixel.
    fn prepare(&self) -> Result<FilterSampler, FilterError> {
        Ok(FilterSampler::pixel())
    }

    fn describe(&self) -> String {
        KIND.name.to_owned()
    }
}

/// `filter = "box"`
pub(super) const KIND: Kind<ReadFilter> =
    Kind { name: "box", meaning: "The pixel itself", keys: &[], read };

fn read(_: &Table) -> Result<Arc<dyn Filter>, Fault> {
    Ok(Arc::new(BoxFilter))
}
