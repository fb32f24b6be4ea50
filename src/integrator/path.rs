//! [`PathIntegrator`]: light of any number of reflections.

use super::transport::{LightChoice, Transport};
use super::{Integrator, Wave};
use crate::sampling::Sampler;
use crate::scene::{LightStrategy, Scene};

/// Paths from the camera that are joined to a light at each hit, and may also end at one by chance
/// (PBRT 3rd edition, section 14.5.4; both ways weighed against each other as in section 13.10.1).
///
/// With several lights, one is chosen at each hit, nine times in ten in proportion to its power. The estimate is unbiased up to `max_depth`
/// reflections: light that is reflected more often is left out.
pub struct PathIntegrator(Transport);

impl PathIntegrator {
    /// Paths of up to `max_depth` reflections through this scene: 0 shows the lights alone, 1 is direct light. With
    /// `roulette`, paths that carry little end at random from the fourth reflection on, and those that
    /// survive count for them.
    ///
    /// # Panics
    /// Rendering another scene with it may panic, or give a wrong picture.
    pub fn new(scene: &Scene, max_depth: u32, roulette: bool, strategy: LightStrategy) -> Self {
        Self(Transport::new(scene, max_depth, roulette, strategy, LightChoice::ByPower))
    }
}

impl Integrator for PathIntegrator {
    fn shade(&self, scene: &Scene, sampler: &dyn Sampler, wave: &mut Wave) {
        self.0.shade(scene, sampler, wave);
    }

    fn shadow_rays(&self) -> usize {
        self.0.shadow_rays()
    }
}

use super::Read;
use crate::params::{Fault, Key, Kind, Table};
use crate::scene::IntegratorSettings;

/// As many as in PBRT by default.
const MAX_DEPTH: Key<u32> =
    Key::new("max_depth", "the most times that light is reflected").default(5);
const ROULETTE: Key<bool> =
    Key::new("roulette", "whether paths that carry little end at random").default(true);

/// `type = "path"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "path",
    meaning: "Light that is reflected up to max_depth times",
    keys: &[&MAX_DEPTH, &ROULETTE, &LightStrategy::KEY],
    read,
};

fn read(table: &Table) -> Result<IntegratorSettings, Fault> {
    Ok(IntegratorSettings::Path {
        max_depth: table.get(&MAX_DEPTH)?,
        roulette: table.get(&ROULETTE)?,
        strategy: table.get(&LightStrategy::KEY)?,
    })
}
