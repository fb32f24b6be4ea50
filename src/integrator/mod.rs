//! Integrators: how much light arrives along camera rays.

mod chapter;
mod direct;
mod wave;

pub use chapter::ChapterIntegrator;
pub use direct::DirectIntegrator;
pub use wave::{Counters, ShadowRays, Wave, dimension};

use glam::Vec2;

use crate::Spectrum;
use crate::bxdf::{Bsdf, TransportMode};
use crate::interaction::SurfaceInteraction;
use crate::light::LightSample;
use crate::sampling::Sampler;
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
        IntegratorSettings::Direct { .. } => Box::new(DirectIntegrator),
        IntegratorSettings::Path { .. } => Box::new(DirectIntegrator),
    }
}

/// A hit in the light of one light, before anyone has looked what stands between.
struct Lit<'a> {
    /// The sample's number in the wave.
    sample: usize,
    si: &'a SurfaceInteraction<'a>,
    bsdf: &'a Bsdf<'a>,
    light: LightSample,
}

/// Calls `shade` for each hit of the wave and each light that shines on it, with the radiance of all
/// samples and with the rays that wait to be traced.
fn for_each_light(
    scene: &Scene,
    sampler: &dyn Sampler,
    wave: &mut Wave,
    mut shade: impl FnMut(Lit, &mut [Spectrum], &mut ShadowRays),
) {
    let Wave { ids, rays, hits, radiance, shadow, arena, counters } = wave;
    for (sample, (ray, hit)) in rays.iter().zip(&*hits).enumerate() {
        if !hit.is_hit() {
            continue;
        }
        let mut si = scene.interaction(ray, hit);
        let bsdf =
            scene.material(hit).compute_scattering(&mut si, arena, TransportMode::Radiance, true);
        for (dimension, light) in (dimension::FIRST_LIGHT..).zip(scene.lights()) {
            // A light without extent takes no sample.
            let u =
                if light.is_delta() { Vec2::ZERO } else { sampler.get_2d(ids[sample], dimension) };
            if let Some(light) = light.sample_li(si.p(), u) {
                shade(Lit { sample, si: &si, bsdf: &bsdf, light }, radiance, shadow);
            }
        }
        counters.rejected += u64::from(bsdf.rejected());
    }
    arena.reset();
}
