//! [`DirectIntegrator`]: light that comes straight from the lights.

use super::transport::{LightChoice, Transport};
use super::{Integrator, Wave};
use crate::sampling::Sampler;
use crate::scene::{LightStrategy, Scene};

/// Radiance that is emitted, or reflected once: the sum over all lights, where nothing stands between
/// (PBRT 3rd edition, section 14.3).
pub struct DirectIntegrator(Transport);

impl DirectIntegrator {
    /// Direct light of this scene.
    ///
    /// # Panics
    /// Rendering another scene with it may panic, or give a wrong picture.
    pub fn new(scene: &Scene, strategy: LightStrategy) -> Self {
        Self(Transport::new(scene, 1, false, strategy, LightChoice::All))
    }
}

impl Integrator for DirectIntegrator {
    fn shade(&self, scene: &Scene, sampler: &dyn Sampler, wave: &mut Wave) {
        self.0.shade(scene, sampler, wave);
    }

    fn shadow_rays(&self) -> usize {
        self.0.shadow_rays()
    }
}

use super::Read;
use crate::params::{Fault, Kind, Table};
use crate::scene::IntegratorSettings;

/// `type = "direct"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "direct",
    meaning: "Light that is emitted, or reflected once",
    keys: &[&LightStrategy::KEY],
    read,
};

fn read(table: &Table) -> Result<IntegratorSettings, Fault> {
    Ok(IntegratorSettings::Direct { strategy: table.get(&LightStrategy::KEY)? })
}
