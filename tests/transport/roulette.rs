//! Russian roulette: where it starts, and what it takes for a path of low throughput. Rays pass straight through a stack
//! of sheets to the sky, with a sample value that ends every path whose survival is not certain.

use lobe::bxdf::{Arena, Bsdf, BxDF, BxdfFlags, BxdfSample};
use lobe::camera::{OrthographicCamera, OrthographicSettings};
use lobe::geometry::float::ONE_MINUS_EPSILON;
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::integrator::PathIntegrator;
use lobe::interaction::SurfaceInteraction;
use lobe::light::SkyLight;
use lobe::material::Material;
use lobe::render::{Sampling, render_with};
use lobe::sampling::{SampleId, Sampler};
use lobe::{FilmSettings, RenderOptions, Scene, Spectrum, View};

use crate::scenes::floor;

/// The middle of the pixel, and this number wherever one is asked for.
struct Always(f32);

impl Sampler for Always {
    fn is_correlated(&self) -> bool {
        false
    }
    fn get_1d(&self, _id: SampleId, _dimension: u32) -> f32 {
        self.0
    }
    fn get_2d(&self, _id: SampleId, _dimension: u32) -> Vec2 {
        Vec2::splat(0.5)
    }
}

/// The border to a medium of relative index `eta`, which light crosses without being bent. `share` of it gets through,
/// and its radiance changes by 1/eta² besides.
#[derive(Clone, Copy)]
struct Sheet {
    share: f32,
    eta: f32,
}

impl BxDF for Sheet {
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::TRANSMISSION | BxdfFlags::SPECULAR
    }
    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        Spectrum::BLACK
    }
    fn pdf(&self, _wo: Vec3, _wi: Vec3) -> f32 {
        0.0
    }
    fn uses_uc(&self) -> bool {
        false
    }
    fn sample_f(&self, wo: Vec3, _uc: f32, _u: Vec2) -> Option<BxdfSample> {
        let f = self.share / (self.eta * self.eta * wo.z.abs());
        Some(BxdfSample::specular(Spectrum::splat(f), -wo, 1.0).transmitted(self.eta))
    }
}

impl Material for Sheet {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        bsdf.add(self as &dyn BxDF);
        bsdf
    }
}

/// The radiance that comes through these sheets from a sky of 1, seen straight on, and the number of rays that left one
/// for another.
fn through(sheets: &[Sheet], integrator: PathIntegrator, u: f32) -> (f32, u64) {
    let mut scene = Scene::builder().light(SkyLight::new(Spectrum::WHITE));
    for (i, &sheet) in sheets.iter().enumerate() {
        let name = i.to_string();
        scene = scene.material(&name, sheet).shape(&name, floor(-(i as f32), 5.0), &name);
    }
    let camera = OrthographicSettings {
        eye: 2.0 * Vec3::Y,
        look_at: Vec3::ZERO,
        up: Vec3::Z,
        ..OrthographicSettings::default()
    };
    let camera = OrthographicCamera::new(&camera, UVec2::ONE).unwrap();
    let view = View::new(camera, FilmSettings::new(1, 1)).unwrap();
    let (sampler, options) = (Always(u), RenderOptions::default());
    let sampling = Sampling::new(&sampler, 1);
    let scene = scene.build().unwrap();
    let rendered = render_with(&scene, &view, &integrator, sampling, &options).unwrap();
    assert_eq!((rendered.non_finite, rendered.counters.rejected), (0, 0));
    (rendered.picture.color[0].to_array()[0], rendered.counters.scattered_rays)
}

const GREY: Sheet = Sheet { share: 0.5, eta: 1.0 };

/// The first two reflections are free; at the third a path ends that carries less than a quarter, unless its ray is the last and
/// looks for lights alone. Survivors make up for those that ended. Caught: roulette one reflection earlier;
/// beta not divided; a weight of 1/2 and of 1/8.
#[test]
fn the_third_reflection_may_be_the_last() {
    let path = PathIntegrator::new(20);
    let (dark, clear) = (Sheet { share: 0.25, ..GREY }, Sheet { share: 1.0, ..GREY });
    assert_eq!(through(&[dark; 2], path, ONE_MINUS_EPSILON), (0.0625, 2));
    assert_eq!(through(&[GREY; 3], path, ONE_MINUS_EPSILON), (0.0, 2));
    assert_eq!(through(&[GREY; 8], path, ONE_MINUS_EPSILON), (0.0, 2));
    assert_eq!(through(&[GREY, GREY, clear, clear], path, ONE_MINUS_EPSILON), (0.25, 4));
    assert_eq!(through(&[GREY; 3], PathIntegrator::new(3), ONE_MINUS_EPSILON).0, 0.125);
    let to_the_end = PathIntegrator { roulette: false, ..path };
    assert_eq!(through(&[GREY; 8], to_the_end, ONE_MINUS_EPSILON), (1.0 / 256.0, 8));
    // At the third sheet 1/8 becomes 1/4, and five more halve it and double it again.
    assert_eq!(through(&[GREY; 8], path, 0.0), (0.25, 8));
    // Half of the paths of 1/8 go on.
    assert_eq!(through(&[GREY; 3], path, 0.49), (0.25, 3));
    assert_eq!(through(&[GREY; 3], path, 0.51), (0.0, 2));
}

/// Refraction into a denser medium changes the radiance and not the light that a path carries: it does not end it. Seen to
/// fail without the product of the indices, and with its inverse.
#[test]
fn refraction_ends_no_path() {
    let path = PathIntegrator::new(20);
    let (into, out) = (Sheet { share: 1.0, eta: 2.0 }, Sheet { share: 1.0, eta: 0.5 });
    assert_eq!(through(&[into; 6], path, ONE_MINUS_EPSILON), (f32::exp2(-12.0), 6));
    let there_and_back = [into, into, into, into, out, out, out, out];
    assert_eq!(through(&there_and_back, path, ONE_MINUS_EPSILON), (1.0, 8));
    // Light that is lost counts in any medium.
    let lossy = Sheet { share: 0.5, ..into };
    assert_eq!(through(&[lossy; 4], path, ONE_MINUS_EPSILON), (0.0, 2));
}
