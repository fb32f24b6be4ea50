//! [`ChapterIntegrator`]: the shading of "PBRT series 8: a first look at reflection and materials" (Dezeming Family 2021,
//! in Chinese, <https://dezeming.top/>), whose section 6 it follows.

use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::traits::{Estimator, Integrator, Read};
use super::wave::{Wave, dimension};
use crate::bxdf::BxdfFlags;
use crate::light::LightSample;
use crate::params::{Fault, Key, Kind, Table};
use crate::sampling::Sampler;
use crate::scene::Scene;

/// Local shading without light transport: the sum of pdf · f · 3 over the directions to all lights, without shadows,
/// falloff or intensity (Dezeming Family 2021, "PBRT series 8", section 6.2).
///
/// The result is a brightness without a unit, not radiance. On a Lambertian surface it is 3 cos θ R / π².
/// With `highlight` it is multiplied by a Blinn-Phong factor,
/// 1.5 (0.2 + 0.2 (n · l) + 0.7 (n · h)³²), where h is halfway between viewer and light. Unlike in the source,
/// n is the shading normal on the viewer's side, so that the winding of the mesh does not matter.
#[derive(Clone, Copy, Debug, Default)]
pub struct ChapterIntegrator {
    /// Whether to multiply by the Blinn-Phong factor.
    pub highlight: bool,
}

/// Brightens the image.
const BRIGHTNESS: f32 = 3.0;

impl Integrator for ChapterIntegrator {
    fn prepare<'a>(&'a self, scene: &'a Scene) -> Box<dyn Estimator + 'a> {
        Box::new(ChapterEstimator { scene, highlight: self.highlight })
    }

    fn describe(&self) -> String {
        let highlight = if self.highlight { " with highlight" } else { "" };
        format!("{}{highlight}", KIND.name)
    }
}

struct ChapterEstimator<'a> {
    scene: &'a Scene,
    highlight: bool,
}

impl Estimator for ChapterEstimator<'_> {
    fn shade(&self, sampler: &dyn Sampler, wave: &mut Wave) {
        let scene = self.scene;
        let Wave { ids, cone, rays, hits, radiance, arena, counters, .. } = wave;
        for (sample, (ray, hit)) in rays.iter().zip(&*hits).enumerate() {
            if !hit.is_hit() {
                continue;
            }
            let mut si = scene.seen(ray, hit, cone.as_ref());
            let bsdf = scene.bsdf(hit, &mut si, arena);
            for (dimension, light) in (dimension::FIRST_LIGHT..).zip(scene.lights()) {
                // Delta lights use no sample value.
                let u = if light.is_delta() {
                    Vec2::ZERO
                } else {
                    sampler.get_2d(ids[sample], dimension)
                };
                if let Some(LightSample { wi, .. }) = light.sample_li(si.p(), u) {
                    let (f, pdf) = bsdf.f_and_pdf(si.wo(), wi, BxdfFlags::all());
                    let n = bsdf.frame().n;
                    let factor = if self.highlight { blinn_phong(n, si.wo(), wi) } else { 1.0 };
                    radiance[sample] += f * (pdf * BRIGHTNESS * factor);
                }
            }
            counters.rejected += u64::from(bsdf.rejected());
        }
        arena.reset();
    }

    fn shadow_rays(&self) -> usize {
        0
    }
}

/// The factor of section 6.2, with the shading normal on the viewer's side.
fn blinn_phong(n: Vec3, wo: Vec3, wi: Vec3) -> f32 {
    let n = if n.dot(wo) < 0.0 { -n } else { n };
    let halfway = (wo + wi).normalize_or_zero();
    let specular = halfway.dot(n).max(0.0).powi(32);
    let diffuse = wi.dot(n).max(0.0);
    1.5 * (0.2 + 0.2 * diffuse + 0.7 * specular)
}

const HIGHLIGHT: Key<bool> =
    Key::new("highlight", "whether to multiply by the Blinn-Phong factor").default(false);

/// `type = "chapter"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "chapter",
    meaning: "A brightness without shadows, falloff and intensity: 3 pdf f, summed over the lights",
    keys: &[&HIGHLIGHT],
    read,
};

fn read(table: &Table) -> Result<Arc<dyn Integrator>, Fault> {
    Ok(Arc::new(ChapterIntegrator { highlight: table.get(&HIGHLIGHT)? }))
}
