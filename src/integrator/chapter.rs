//! [`ChapterIntegrator`]: the chapter's estimator.

use glam::Vec3;

use super::{Integrator, Lit, Wave, for_each_light};
use crate::bxdf::BxdfFlags;
use crate::interaction::SurfaceInteraction;
use crate::sampling::Sampler;
use crate::scene::Scene;

/// The chapter's way to show a surface before there is light transport: pdf · f · 3 for the direction
/// to each light, without shadow, falloff or intensity (section 6.2).
///
/// What comes out is a brightness without a unit, not radiance. On a Lambertian surface it is 3 cos θ R / π². With `highlight` it is multiplied by the chapter's
/// Blinn-Phong factor, 1.5 (0.2 + 0.2 (n · l) + 0.7 (n · h)³²), h halfway between viewer and light.
/// Unlike there, n is the shading normal on the viewer's side, so that the winding of the mesh does
/// not matter.
#[derive(Clone, Copy, Debug, Default)]
pub struct ChapterIntegrator {
    /// Whether to multiply by the Blinn-Phong factor.
    pub highlight: bool,
}

/// The chapter's factor against a picture that is too dark.
const BRIGHTNESS: f32 = 3.0;

impl Integrator for ChapterIntegrator {
    fn shade(&self, scene: &Scene, sampler: &dyn Sampler, wave: &mut Wave) {
        for_each_light(scene, sampler, wave, |Lit { sample, si, bsdf, light }, radiance, _| {
            let f = bsdf.f(si.wo(), light.wi, BxdfFlags::all());
            let pdf = bsdf.pdf(si.wo(), light.wi, BxdfFlags::all());
            let factor = if self.highlight { blinn_phong(si, light.wi) } else { 1.0 };
            radiance[sample] += f * (pdf * BRIGHTNESS * factor);
        });
    }
}

/// The factor of section 6.2.
fn blinn_phong(si: &SurfaceInteraction, wi: Vec3) -> f32 {
    let n = if si.shading_n().dot(si.wo()) < 0.0 { -si.shading_n() } else { si.shading_n() };
    let halfway = (si.wo() + wi).normalize_or_zero();
    let specular = halfway.dot(n).max(0.0).powi(32);
    let diffuse = wi.dot(n).max(0.0);
    1.5 * (0.2 + 0.2 * diffuse + 0.7 * specular)
}
