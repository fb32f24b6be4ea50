//! [`DirectIntegrator`]: light that comes straight from the lights.

use super::{Integrator, Lit, Wave, for_each_light};
use crate::bxdf::BxdfFlags;
use crate::sampling::Sampler;
use crate::scene::Scene;

/// Radiance reflected once: the sum over all lights of f Li |cos θi| / pdf, where nothing stands
/// between (PBRT 3rd edition, section 14.3).
#[derive(Clone, Copy, Debug, Default)]
pub struct DirectIntegrator;

impl Integrator for DirectIntegrator {
    fn shade(&self, scene: &Scene, sampler: &dyn Sampler, wave: &mut Wave) {
        for_each_light(scene, sampler, wave, |Lit { sample, si, bsdf, light }, _, shadow| {
            let f = bsdf.f(si.wo(), light.wi, BxdfFlags::all());
            // Light that will not be reflected need not be asked for.
            if !f.is_black() {
                let ray = match light.from {
                    Some(from) => si.spawn_ray_to(from),
                    None => si.spawn_ray(light.wi),
                };
                let cos_theta = light.wi.dot(si.shading_n()).abs();
                let radiance = f * light.li * (cos_theta / light.pdf);
                shadow.push(sample, ray, radiance);
            }
        });
        wave.counters.shadow_rays += wave.shadow.trace(scene, &mut wave.radiance);
    }
}
