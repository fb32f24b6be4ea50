//! Integrators: how much light arrives along camera rays.

mod chapter;
mod direct;
mod wave;

pub use chapter::ChapterIntegrator;
pub use direct::DirectIntegrator;
pub use wave::{Counters, ShadowRays, Wave, dimension};

use glam::{Vec2, Vec3};

use crate::light::{Light, LightSample};
use crate::sampling::{SampleId, Sampler};
use crate::scene::{IntegratorSettings, Scene};

/// A way to compute light. It works on many camera rays at once, a [`Wave`], so that rays can be
/// traced in batches.
pub trait Integrator: Send + Sync {
    /// Adds to `wave.radiance` what arrives along each camera ray, whose hits are known already.
    /// Samples come from `sampler` by the number in `wave.ids`, in dimensions from
    /// [`dimension::FIRST_LIGHT`] on.
    fn shade(&self, scene: &Scene, sampler: &dyn Sampler, wave: &mut Wave);
}

/// The integrator that the settings ask for.
pub(crate) fn from_settings(settings: &IntegratorSettings) -> Box<dyn Integrator> {
    match *settings {
        IntegratorSettings::Chapter { highlight } => Box::new(ChapterIntegrator { highlight }),
        IntegratorSettings::Direct => Box::new(DirectIntegrator),
    }
}

/// Light towards `p` from each light that sheds any. A light without extent takes no sample.
fn light_samples(
    scene: &Scene,
    sampler: &dyn Sampler,
    id: SampleId,
    p: Vec3,
) -> impl Iterator<Item = LightSample> {
    let draw = move |(number, light): (usize, &std::sync::Arc<dyn Light>)| {
        let dimension = dimension::FIRST_LIGHT + number as u32;
        let u = if light.is_delta() { Vec2::ZERO } else { sampler.get_2d(id, dimension) };
        light.sample_li(p, u)
    };
    scene.lights().iter().enumerate().filter_map(draw)
}
