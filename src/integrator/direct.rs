//! [`DirectIntegrator`]: light that comes straight from the lights.

use super::{Integrator, Wave, light_samples};
use crate::bxdf::{BxdfFlags, TransportMode};
use crate::sampling::Sampler;
use crate::scene::Scene;

/// Radiance reflected once: the sum over all lights of f Li |cos θi| / pdf, where nothing stands
/// between (PBRT 3rd edition, section 14.3).
#[derive(Clone, Copy, Debug, Default)]
pub struct DirectIntegrator;

impl Integrator for DirectIntegrator {
    fn shade(&self, scene: &Scene, sampler: &dyn Sampler, wave: &mut Wave) {
        for (sample, (ray, hit)) in wave.rays.iter().zip(&wave.hits).enumerate() {
            if !hit.is_hit() {
                continue;
            }
            let mut si = scene.interaction(ray, hit);
            let material = scene.material(hit);
            let bsdf =
                material.compute_scattering(&mut si, &wave.arena, TransportMode::Radiance, true);
            for light in light_samples(scene, sampler, wave.ids[sample], si.p()) {
                let f = bsdf.f(si.wo(), light.wi, BxdfFlags::all());
                // Light that will not be reflected need not be asked for.
                if f.is_black() {
                    continue;
                }
                let cos_theta = light.wi.dot(si.shading_n()).abs();
                let radiance = f * light.li * (cos_theta / light.pdf);
                wave.shadow.push(sample, si.spawn_ray_to(light.from), radiance);
            }
            wave.counters.rejected += u64::from(bsdf.rejected());
        }
        wave.arena.reset();
        wave.counters.shadow_rays += wave.shadow.trace(scene, &mut wave.radiance);
    }
}
