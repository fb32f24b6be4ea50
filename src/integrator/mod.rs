//! Integrators: how much light arrives along camera rays.
//!
//! Each algorithm stands in its own file from top to bottom: [`ChapterIntegrator`], [`DirectIntegrator`],
//! [`PathIntegrator`]. They work on waves of samples, stage by stage; the stages that they share are in `wave/`.

mod chapter;
mod direct;
mod path;
mod traits;
mod wave;

pub use chapter::ChapterIntegrator;
pub use direct::DirectIntegrator;
pub use path::PathIntegrator;
pub use traits::{Estimator, Integrator, Read};
pub use wave::{Counters, ShadowRays, Wave, dimension};

use crate::params::Kind;
use crate::scene::IntegratorSettings;

/// All kinds of integrators.
pub static INTEGRATORS: &[Kind<Read>] = &[path::KIND, direct::KIND, chapter::KIND];

/// The integrator that the settings ask for.
pub(crate) fn from_settings(settings: &IntegratorSettings) -> Box<dyn Integrator> {
    match *settings {
        IntegratorSettings::Chapter { highlight } => Box::new(ChapterIntegrator { highlight }),
        IntegratorSettings::Direct { strategy } => Box::new(DirectIntegrator { strategy }),
        IntegratorSettings::Path { max_depth, roulette, strategy } => {
            Box::new(PathIntegrator { max_depth, roulette, strategy })
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
