//! Integrators: how much light arrives along camera rays.

mod chapter;
mod direct;
mod wave;

pub use chapter::ChapterIntegrator;
pub use direct::DirectIntegrator;
pub use wave::{Counters, ShadowRays, Wave};

use crate::scene::{IntegratorSettings, Scene};

/// A way to compute light. It works on many camera rays at once, a [`Wave`], so that rays can be
/// traced in batches.
pub trait Integrator: Send + Sync {
    /// Adds to `wave.radiance` what arrives along each camera ray, whose hits are known already.
    fn shade(&self, scene: &Scene, wave: &mut Wave);
}

/// The integrator that the settings ask for.
pub fn from_settings(settings: &IntegratorSettings) -> Box<dyn Integrator> {
    match *settings {
        IntegratorSettings::Chapter { highlight } => Box::new(ChapterIntegrator { highlight }),
        IntegratorSettings::Direct => Box::new(DirectIntegrator),
    }
}
