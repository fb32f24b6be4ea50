//! [`BlackmanHarrisFilter`]: the four-term Blackman-Harris window.

use std::f64::consts::PI;
use std::sync::Arc;

use super::parameters::radius_key;
use super::traits::{Filter, ReadFilter};
use crate::params::{Fault, Key, Kind, Table};

/// The four-term Blackman-Harris window (Harris 1978, "On the use of windows for harmonic
/// analysis with the discrete Fourier transform", section V.H).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlackmanHarrisFilter {
    /// Half of its width on each axis.
    pub radius: f32,
}

impl Default for BlackmanHarrisFilter {
    /// Radius 1.5.
    fn default() -> Self {
        Self { radius: RADIUS.default_value() }
    }
}

impl Filter for BlackmanHarrisFilter {
    fn radius(&self) -> f32 {
        self.radius
    }

    fn profile(&self, x: f64) -> f64 {
        let cosine = |k: f64| (k * PI * x / f64::from(self.radius)).cos();
        0.35875 + 0.48829 * cosine(1.0) + 0.14128 * cosine(2.0) + 0.01168 * cosine(3.0)
    }

    fn describe(&self) -> String {
        format!("{}, radius {} pixels", KIND.name, self.radius)
    }
}

const RADIUS: Key<f32> = radius_key(1.5);

/// `filter = "blackman-harris"`
pub(super) const KIND: Kind<ReadFilter> = Kind {
    name: "blackman-harris",
    meaning: "The window of Blackman and Harris with four terms",
    keys: &[&RADIUS],
    read,
};

fn read(table: &Table) -> Result<Arc<dyn Filter>, Fault> {
    Ok(Arc::new(BlackmanHarrisFilter { radius: table.get(&RADIUS)? }))
}
