//! [`AlbedoIntegrator`]: the albedo of what is seen first, estimated in three ways.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::traits::{Estimator, Integrator};
use super::wave::{Wave, dimension};
use crate::bxdf::{Bsdf, BxdfFlags};
use crate::sampling::{SampleId, Sampler, cosine_hemisphere};
use crate::scene::Scene;
use crate::spectrum::Spectrum;

/// The fraction of uniform light that the surface seen first returns towards the camera, as a mean over the bands:
///
/// - red: samples of the surface, f |cos θ| / pdf;
/// - green: f asked at the directions of these samples, over the pdf asked there;
/// - blue: f at cosine-weighted directions of the whole sphere.
///
/// Specular events, which have no f, are added to all three. The factor 1/η² of refraction is taken out by the index of the surface's own
/// samples: of surfaces with refractions of several indices blue is wrong. Black where nothing is hit.
///
/// Surfaces that keep the contracts of [`BxDF`](crate::bxdf::BxDF) are grey: any tint beyond noise is a bug. (The idea is
/// that of RenderMan's `PxrValidateBxdf`.)
///
/// ```
/// use lobe::glam::Vec3;
/// use lobe::integrator::AlbedoIntegrator;
/// use lobe::render::SamplerSettings;
/// use lobe::scene::{FilmSettings, Scene, View};
/// use lobe::{MatteMaterial, PerspectiveSettings, RenderOptions, RenderSettings, TriangleMesh, render};
///
/// let wall = TriangleMesh::parallelogram(Vec3::new(-9.0, -9.0, 1.0), 18.0 * Vec3::X, 18.0 * Vec3::Y);
/// let scene = Scene::builder().material("grey", MatteMaterial::new([0.4; 3])).shape("wall", wall, "grey").build()?;
/// let view = View::perspective(&PerspectiveSettings::default(), FilmSettings::new(8, 8))?;
/// let settings = RenderSettings::new(SamplerSettings::default(), AlbedoIntegrator);
/// let rendered = render(&scene, &view, &settings, &RenderOptions::default())?;
/// assert!(rendered.picture.color[0].to_array().iter().all(|band| (band - 0.4).abs() < 1e-4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AlbedoIntegrator;

impl Integrator for AlbedoIntegrator {
    fn prepare<'a>(&'a self, scene: &'a Scene) -> Box<dyn Estimator + 'a> {
        Box::new(AlbedoEstimator { scene })
    }

    fn describe(&self) -> String {
        "albedo in three ways".to_owned()
    }
}

struct AlbedoEstimator<'a> {
    scene: &'a Scene,
}

impl Estimator for AlbedoEstimator<'_> {
    fn shade(&self, sampler: &dyn Sampler, wave: &mut Wave) {
        let scene = self.scene;
        let Wave { ids, cone, rays, hits, radiance, arena, counters, .. } = wave;
        for (sample, (ray, hit)) in rays.iter().zip(&*hits).enumerate() {
            if !hit.is_hit() {
                continue;
            }
            let mut si = scene.seen(ray, hit, cone.as_ref());
            let bsdf = scene.bsdf(hit, &mut si, arena);
            let numbers = Numbers::new(sampler, ids[sample]);
            let by_samples = own(&bsdf, si.wo(), &numbers);
            let (red, green) = (by_samples.sampled, by_samples.evaluated);
            let blue = by_samples.specular + of_sphere(&bsdf, si.wo(), &numbers);
            radiance[sample] += Spectrum::new(red, green, blue);
            counters.rejected += u64::from(bsdf.rejected());
        }
        arena.reset();
    }

    fn shadow_rays(&self) -> usize {
        0
    }
}

/// Sample values of a hit.
struct Numbers {
    uc: f32,
    u: Vec2,
    /// For the direction on the sphere, above and below.
    sphere: [Vec2; 2],
}

impl Numbers {
    fn new(sampler: &dyn Sampler, id: SampleId) -> Self {
        let of = |offset: u32| sampler.get_2d(id, dimension::FIRST_LIGHT + offset);
        Self { uc: sampler.get_1d(id, dimension::event(0)), u: of(0), sphere: [of(1), of(2)] }
    }
}

/// An estimate by a sample of the surface.
#[derive(Default)]
struct BySample {
    sampled: f32,
    evaluated: f32,
    /// What specular events contribute to both.
    specular: f32,
}

fn own(bsdf: &Bsdf, wo: Vec3, numbers: &Numbers) -> BySample {
    let all = BxdfFlags::all();
    let Some(sample) = bsdf.sample_f(wo, numbers.uc, numbers.u, all) else {
        return BySample::default();
    };
    let cos = bsdf.abs_cos_theta(sample.wi) * sample.eta * sample.eta;
    let sampled = mean(sample.f) * cos / sample.pdf;
    if sample.is_specular() {
        return BySample { sampled, evaluated: sampled, specular: sampled };
    }
    let (f, pdf) = bsdf.f_and_pdf(wo, sample.wi, all);
    let evaluated = if pdf > 0.0 { mean(f) * cos / pdf } else { 0.0 };
    BySample { sampled, evaluated, specular: 0.0 }
}

/// The integral of f |cos θ| by one direction of each hemisphere, with the density |cos θ| / π.
fn of_sphere(bsdf: &Bsdf, wo: Vec3, numbers: &Numbers) -> f32 {
    let frame = bsdf.frame();
    let f = |w: Vec3| mean(bsdf.f(wo, frame.to_world(w), BxdfFlags::all()));
    let [above, below] = numbers.sphere.map(cosine_hemisphere::sample);
    let (above, below) = (f(above), f(-below));
    let (same, other) = if wo.dot(frame.n) > 0.0 { (above, below) } else { (below, above) };
    // Most surfaces are opaque.
    let eta = if other == 0.0 { 1.0 } else { index(bsdf, wo, numbers.u) };
    PI * (same + other * eta * eta)
}

/// The relative index of a refraction from `wo`; 1 if the surface refracts none.
fn index(bsdf: &Bsdf, wo: Vec3, u: Vec2) -> f32 {
    const TRIALS: u32 = 32;
    // A direction may be one of a facet with total reflection: each trial has another.
    let etas = (0..TRIALS).filter_map(|i| {
        let uc = (i as f32 + 0.5) / TRIALS as f32;
        let u = (u + i as f32 * Vec2::new(0.754_877_7, 0.569_840_3)).fract();
        Some(bsdf.sample_f(wo, uc, u, BxdfFlags::all())?.eta)
    });
    etas.into_iter().find(|&eta| eta != 1.0).unwrap_or(1.0)
}

fn mean(f: Spectrum) -> f32 {
    let [r, g, b] = f.to_array();
    (r + g + b) / 3.0
}
