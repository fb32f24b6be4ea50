//! [`GaussianFilter`]: a truncated Gaussian.

use std::sync::Arc;

use super::parameters::{FilterError, check_radius, radius_key};
use super::sampler::FilterSampler;
use super::traits::{Filter, ReadFilter};
use crate::params::{Fault, Key, Kind, Table};

/// A Gaussian minus its value at the radius, so that it ends without a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussianFilter {
    /// Half of its width on each axis.
    pub radius: f32,
    /// Standard deviation of the untruncated Gaussian.
    pub sigma: f32,
}

impl Default for GaussianFilter {
    /// Sigma 0.5 and radius 1.5.
    fn default() -> Self {
        Self { radius: RADIUS.default_value(), sigma: SIGMA.default_value() }
    }
}

impl Filter for GaussianFilter {
    fn radius(&self) -> f32 {
        self.radius
    }

    fn profile(&self, x: f64) -> f64 {
        // exp(-a) - exp(-b) without cancellation, however flat the Gaussian is.
        let exponent = |x: f64| 0.5 * (x / f64::from(self.sigma)).powi(2);
        let (a, b) = (exponent(x), exponent(f64::from(self.radius)));
        -(-a).exp() * (a - b).exp_m1()
    }

    fn check(&self) -> Result<(), FilterError> {
        check_radius(self.radius)?;
        if !(SIGMA.limits().contains_f32(self.sigma) && self.sigma.is_finite()) {
            return Err(FilterError::Sigma(self.sigma));
        }
        Ok(())
    }

    /// Tabulated up to 6.5 standard deviations: beyond lies less than 2⁻³³ of a Gaussian.
    fn prepare(&self) -> Result<FilterSampler, FilterError> {
        self.check()?;
        FilterSampler::from_profile(self.radius.min(6.5 * self.sigma), |x| self.profile(x))
    }

    fn describe(&self) -> String {
        format!("{}, radius {} pixels, sigma {}", KIND.name, self.radius, self.sigma)
    }
}

const RADIUS: Key<f32> = radius_key(1.5);
const SIGMA: Key<f32> = Key::new("filter_sigma", "standard deviation of the whole Gaussian")
    .in_unit("pixels")
    .above(0.0)
    .default(0.5);

/// `filter = "gaussian"`
pub(super) const KIND: Kind<ReadFilter> = Kind {
    name: "gaussian",
    meaning: "A Gaussian minus its value at the radius",
    keys: &[&RADIUS, &SIGMA],
    read,
};

fn read(table: &Table) -> Result<Arc<dyn Filter>, Fault> {
    Ok(Arc::new(GaussianFilter { radius: table.get(&RADIUS)?, sigma: table.get(&SIGMA)? }))
}
