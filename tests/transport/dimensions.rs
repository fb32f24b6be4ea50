//! No number of a sample is used for two purposes. Otherwise what should be independent is not, and results are wrong
//! in a way that depends on the sampler.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use lobe::bxdf::{Arena, Bsdf, BxDF, BxdfFlags, BxdfSample};
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::integrator::{ChapterIntegrator, DirectIntegrator, Integrator, PathIntegrator};
use lobe::interaction::SurfaceInteraction;
use lobe::light::{LightStrategy, SkyLight};
use lobe::material::Material;
use lobe::render::{Sampling, render_with};
use lobe::sampling::{IndependentSampler, SampleId, Sampler, cosine_hemisphere};
use lobe::scene::Emission;
use lobe::{PerspectiveSettings, RenderOptions, Scene, Spectrum};

use crate::scenes::{any, ball_over_floor, chapter_camera, floor, view};

/// Counts how often each dimension of each sample is asked for.
#[derive(Default)]
struct Recorder {
    asked: Mutex<BTreeMap<(u32, u32, u32, u32), u32>>,
}

impl Recorder {
    fn record(&self, id: SampleId, dimension: u32) {
        let key = (id.pixel.y, id.pixel.x, id.index, dimension);
        *self.asked.lock().unwrap().entry(key).or_default() += 1;
    }
}

impl Sampler for Recorder {
    fn is_correlated(&self) -> bool {
        false
    }
    fn get_1d(&self, id: SampleId, dimension: u32) -> f32 {
        self.record(id, dimension);
        IndependentSampler::new(1).get_1d(id, dimension)
    }
    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2 {
        self.record(id, dimension);
        IndependentSampler::new(1).get_2d(id, dimension)
    }
}

/// White, and mirrors half of the time, by `uc`.
struct Half;

impl BxDF for Half {
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE | BxdfFlags::SPECULAR
    }
    fn uses_uc(&self) -> bool {
        true
    }
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        Spectrum::splat(if wo.z * wi.z > 0.0 { 0.5 / std::f32::consts::PI } else { 0.0 })
    }
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if wo.z * wi.z > 0.0 { 0.5 * wi.z.abs() / std::f32::consts::PI } else { 0.0 }
    }
    fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample> {
        if uc < 0.5 {
            let wi = Vec3::new(-wo.x, -wo.y, wo.z);
            return Some(BxdfSample::specular(Spectrum::splat(0.5 / wo.z.abs()), wi, 0.5));
        }
        let wi = cosine_hemisphere::sample(u) * Vec3::new(1.0, 1.0, wo.z.signum());
        Some(BxdfSample::diffuse(self.f(wo, wi), wi, self.pdf(wo, wi)))
    }
}

impl Material for Half {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        bsdf.add(self as &dyn BxDF);
        bsdf
    }
}

/// A ball of `Half` over a matte floor, under two lamps and a sky, in a thin lens's view.
fn scene() -> Scene {
    let lamp = |x: f32| {
        let mut mesh = floor(3.0, 0.5);
        mesh.positions.iter_mut().for_each(|p| p.x += x);
        mesh
    };
    let emission = Emission { radiance: Spectrum::splat(3.0), two_sided: true };
    ball_over_floor()
        .material("half", Half)
        .shape("wall", floor(-1.0, 2.0), "half")
        .lamp("left", lamp(-2.0), emission)
        .lamp("right", lamp(2.0), emission)
        .light(SkyLight::new(Spectrum::WHITE))
        .build()
        .unwrap()
}

/// Seen to fail with one dimension for light choice and roulette, with one for next directions and points on
/// lights, with the same events at each depth, and with one dimension for all lights of the chapter's estimator.
#[test]
fn no_number_is_used_twice() {
    let path = |strategy| PathIntegrator { strategy, ..PathIntegrator::new(8) };
    let integrators: [Arc<dyn Integrator>; 5] = [
        any(path(LightStrategy::Auto)),
        any(path(LightStrategy::Mis)),
        any(path(LightStrategy::Bsdf)),
        any(DirectIntegrator { strategy: LightStrategy::Mis }),
        any(ChapterIntegrator::default()),
    ];
    let scene = scene();
    let camera = PerspectiveSettings { lens_radius: 0.1, focal_distance: 3.0, ..chapter_camera() };
    for integrator in integrators {
        let what = integrator.describe();
        let sampler = Recorder::default();
        let view = view(&camera, UVec2::splat(24));
        let sampling = Sampling::new(&sampler, 2);
        render_with(&scene, &view, &*integrator, sampling, &RenderOptions::default()).unwrap();
        let asked = sampler.asked.into_inner().unwrap();
        for ((y, x, index, dimension), times) in &asked {
            assert_eq!(*times, 1, "{what}: dimension {dimension} of {index} in pixel ({x}, {y})");
        }
        let dimensions = asked.keys().map(|key| key.3).max().unwrap();
        assert!(dimensions >= 3, "{what}: only {dimensions}");
    }
}
