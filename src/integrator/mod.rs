//! Integrators: how much light arrives along camera rays.

mod chapter;
mod direct;
mod path;
mod paths;
mod plain;
mod plain_lights;
mod scatter;
mod transport;
mod wave;

pub use chapter::ChapterIntegrator;
pub use direct::DirectIntegrator;
pub use path::PathIntegrator;
pub use wave::{Counters, ShadowRays, Wave, dimension};

use crate::params::{Fault, Kind, Table};
use crate::sampling::Sampler;
use crate::scene::{IntegratorSettings, Scene};

/// How a kind of integrator is read.
pub type Read = fn(&Table) -> Result<IntegratorSettings, Fault>;

/// All kinds of integrators; the first one is the default.
pub static INTEGRATORS: &[Kind<Read>] = &[chapter::KIND, direct::KIND, path::KIND];

/// A way to compute light. It works on many camera rays at once, a [`Wave`], so that rays can be
/// traced in batches.
pub trait Integrator: Send + Sync {
    /// Adds to `wave.radiance` what arrives along each camera ray, whose hits are known already.
    /// Samples come from `sampler` by the number in `wave.ids`, in dimensions from
    /// [`dimension::FIRST_LIGHT`] on.
    fn shade(&self, scene: &Scene, sampler: &dyn Sampler, wave: &mut Wave);

    /// The most rays towards lights that a sample has waiting at a time, so that room can be made for them
    /// beforehand.
    fn shadow_rays(&self) -> usize {
        1
    }
}

/// The integrator that the settings ask for.
pub(crate) fn from_settings(scene: &Scene, settings: &IntegratorSettings) -> Box<dyn Integrator> {
    match *settings {
        IntegratorSettings::Chapter { highlight } => Box::new(ChapterIntegrator { highlight }),
        IntegratorSettings::Direct { strategy } => Box::new(DirectIntegrator::new(scene, strategy)),
        IntegratorSettings::Path { max_depth, roulette, strategy } => {
            Box::new(PathIntegrator::new(scene, max_depth, roulette, strategy))
        }
    }
}

/// The name in scene files of the kind that settings are of.
pub fn name(settings: &IntegratorSettings) -> &'static str {
    match settings {
        IntegratorSettings::Chapter { .. } => chapter::KIND.name,
        IntegratorSettings::Direct { .. } => direct::KIND.name,
        IntegratorSettings::Path { .. } => path::KIND.name,
    }
}
