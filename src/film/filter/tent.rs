//! [`TentFilter`]: falls linearly.

use std::sync::Arc;

use super::parameters::{FilterError, radius_key};
use super::sampler::FilterSampler;
use super::traits::{Filter, ReadFilter};
use crate::params::{Fault, Key, Kind, Table};

/// Falls linearly to zero at the radius (PBRT's triangle filter).
#[doc(alias = "triangle filter")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TentFilter {
    /// Half of its width on each axis.
    pub radius: f32,
}

impl Default for TentFilter {
    /// Reaches the centres of the neighbouring pixels.
    fn default() -> Self {
        Self { radius: RADIUS.default_value() }
    }
}

impl Filter for TentFilter {
    fn radius(&self) -> f32 {
        self.radius
    }

    fn profile(&self, x: f64) -> f64 {
        1.0 - x / f64::from(self.radius)
    }

    /// In closed form.
    fn prepare(&self) -> Result<FilterSampler, FilterError> {
        FilterSampler::triangular(self.radius)
    }

    fn describe(&self) -> String {
        format!("{}, radius {} pixels", KIND.name, self.radius)
    }
}

const RADIUS: Key<f32> = radius_key(1.0);

/// `filter = "tent"`
pub(super) const KIND: Kind<ReadFilter> =
    Kind { name: "tent", meaning: "Falls linearly to zero at the radius", keys: &[&RADIUS], read };

fn read(table: &Table) -> Result<Arc<dyn Filter>, Fault> {
    Ok(Arc::new(TentFilter { radius: table.get(&RADIUS)? }))
}
