//! [`DirectIntegrator`]: emission and direct light.

use std::sync::Arc;

use super::path::PathTracer;
use super::traits::{Estimator, Integrator, Read};
use crate::light::{LightChoice, LightStrategy};
use crate::params::{Choice, Fault, Kind, Table};
use crate::scene::Scene;

/// Direct lighting: radiance that is emitted, or reflected once, with shadows (PBRT 3rd edition, section 14.3).
///
/// It traces paths with a single reflection, and samples each light at a hit instead of one of them.
#[doc(alias = "direct lighting")]
#[doc(alias = "next-event estimation")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DirectIntegrator {
    /// How directions to lights are sampled.
    pub strategy: LightStrategy,
}

impl Integrator for DirectIntegrator {
    fn prepare<'a>(&'a self, scene: &'a Scene) -> Box<dyn Estimator + 'a> {
        let (max_depth, roulette) = (1, false);
        Box::new(PathTracer::new(scene, max_depth, roulette, self.strategy, LightChoice::All))
    }

    fn describe(&self) -> String {
        format!("{}, strategy {}", KIND.name, self.strategy.name())
    }
}

/// `type = "direct"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "direct",
    meaning: "Light that is emitted, or reflected once",
    keys: &[&LightStrategy::KEY],
    read,
};

fn read(table: &Table) -> Result<Arc<dyn Integrator>, Fault> {
    Ok(Arc::new(DirectIntegrator { strategy: table.get(&LightStrategy::KEY)? }))
}
