//! Lights of another crate.

use std::collections::HashSet;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use lobe::geometry::BoundedPoint;
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::integrator::PathIntegrator;
use lobe::light::{
    BoundingSphere, Light, LightHit, LightSample, LightStrategy, PointLight, SkyLight,
};
use lobe::sampling::uniform_triangle;
use lobe::scene::{Emission, SceneBuilder, SceneError};
use lobe::{RenderOptions, Scene, Spectrum, TriangleMesh, render};

use crate::scenes::{ball_over_floor, chapter_view, independent, lumpy_ball};
use crate::statistics::{assert_alike, bands, picture};

/// A point light that returns the given power, which may be unknown.
struct Shy {
    light: PointLight,
    told: Option<f32>,
}

impl Light for Shy {
    fn is_delta(&self) -> bool {
        true
    }
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        self.light.sample_li(p, u)
    }
    fn power(&self, _scene: &BoundingSphere) -> Option<Spectrum> {
        self.told.map(Spectrum::splat)
    }
}

const HERE: Vec3 = Vec3::new(3.0, 4.0, -3.0);
const THERE: Vec3 = Vec3::new(-4.0, 3.0, -2.0);

fn lit(lights: impl Fn(SceneBuilder) -> SceneBuilder) -> Vec<(f64, f64)> {
    let settings = independent(512, PathIntegrator::new(1));
    bands(&picture(lights(ball_over_floor()), &chapter_view(UVec2::splat(24)), &settings))
}

/// A light is found whatever its `power` returns: next to another light the picture is the sum of both.
/// Caught: lights without power left out of the choice (0.7956 alone, 0 beside another one).
#[test]
fn lights_of_unknown_power_are_found() {
    let light = |p, i| PointLight::new(p, Spectrum::splat(i));
    let [one, other] = [light(HERE, 40.0), light(THERE, 60.0)];
    let alone = [one, other].map(|light| lit(|scene| scene.light(light)));
    let sum: Vec<(f64, f64)> =
        alone[0].iter().zip(&alone[1]).map(|(a, b)| (a.0 + b.0, a.1 + b.1)).collect();
    for told in [None, Some(0.0), Some(1e30), Some(f32::NAN)] {
        let both = lit(|scene| scene.light(Shy { light: one, told }).light(other));
        assert_alike(&sum, &both, &format!("told {told:?}"));
    }
}

/// A lamp's mesh, seen from below.
fn panel() -> TriangleMesh {
    TriangleMesh::parallelogram(Vec3::new(-1.0, 2.5, -1.0), 2.0 * Vec3::X, 2.0 * Vec3::Z)
}

const RADIANCE: Spectrum = Spectrum::new(6.0, 4.0, 2.0);

/// A lamp of another crate over that mesh, sampled by area: triangles and points at random.
struct Panel;

impl Panel {
    fn pdf(distance: f32, cos_theta: f32) -> f32 {
        distance * distance / (4.0 * cos_theta.abs())
    }
}

impl Light for Panel {
    fn is_delta(&self) -> bool {
        false
    }
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        let (mesh, triangle) = (panel(), usize::from(u.x >= 0.5));
        let b = uniform_triangle::sample(Vec2::new(2.0 * u.x - triangle as f32, u.y));
        let point = BoundedPoint::on_triangle(mesh.corners(triangle), [b.x, b.y, 1.0 - b.x - b.y]);
        let to_light = point.p - p;
        let n = mesh.geometric_normal(triangle);
        let pdf = Self::pdf(to_light.length(), to_light.normalize().dot(n));
        LightSample::from_surface(p, point, n, RADIANCE, pdf)
    }
    fn pdf_li(&self, hit: &LightHit) -> f32 {
        Self::pdf(hit.distance, hit.wi.dot(hit.n))
    }
    fn le(&self, _hit: &LightHit) -> Spectrum {
        RADIANCE
    }
}

/// A lamp of another crate on a mesh, without thought of rounding, gives what the crate's own gives.
/// Caught: points that are not offset, so that the lamp's surface blocks some of its own light.
#[test]
fn a_light_on_a_mesh_does_not_shadow_itself() {
    let lit = |add: &dyn Fn(SceneBuilder) -> SceneBuilder| {
        let integrator =
            PathIntegrator { strategy: LightStrategy::Light, ..PathIntegrator::new(1) };
        let view = chapter_view(UVec2::splat(24));
        bands(&picture(add(ball_over_floor()), &view, &independent(512, integrator)))
    };
    let emission = Emission { radiance: RADIANCE, two_sided: true };
    let own = lit(&|scene| scene.lamp("panel", panel(), emission));
    let foreign = lit(&|scene| scene.shape_with_light("panel", panel(), None, Panel));
    assert_alike(&own, &foreign, "a lamp of another crate");
}

/// A light that rays hit without a density is counted, and does not count twice in silence. Caught: a default density of
/// 0, which gives light that was sampled already its whole weight.
#[test]
fn a_light_without_density_is_counted() {
    struct Forgetful;
    impl Light for Forgetful {
        fn is_delta(&self) -> bool {
            false
        }
        fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
            Panel.sample_li(p, u)
        }
        fn le(&self, hit: &LightHit) -> Spectrum {
            Panel.le(hit)
        }
    }
    let non_finite = |light: Arc<dyn Light>| {
        let scene = ball_over_floor().shape_with_light("panel", panel(), None, light);
        let settings = independent(16, PathIntegrator::new(3));
        let view = chapter_view(UVec2::splat(24));
        let options = RenderOptions::default();
        render(&scene.build().unwrap(), &view, &settings, &options).unwrap().non_finite
    };
    assert_eq!(non_finite(Arc::new(Panel)), 0);
    assert!(non_finite(Arc::new(Forgetful)) > 0);
}

/// Caught: emission that is taken as it is.
#[test]
fn emission_is_checked() {
    for (radiance, good) in
        [([0.0, 1.0, 2.0], true), ([0.0, -1.0, 2.0], false), ([f32::NAN; 3], false)]
    {
        let emission = Emission { radiance: Spectrum::from(radiance), two_sided: false };
        match Scene::builder().lamp("panel", panel(), emission).build() {
            Ok(_) => assert!(good, "{radiance:?}"),
            Err(SceneError::Emission { shape, .. }) => assert!(!good && shape == "panel"),
            Err(error) => panic!("{error}"),
        }
    }
}

/// Remembers the points that it was sampled for, and how often it was asked for the density from another point.
struct Remembers {
    is_sky: bool,
    sampled: Arc<Mutex<HashSet<[u32; 3]>>>,
    densities: Arc<[AtomicU64; 2]>,
}

impl Light for Remembers {
    fn is_delta(&self) -> bool {
        false
    }
    fn is_infinite(&self) -> bool {
        self.is_sky
    }
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        self.sampled.lock().unwrap().insert(p.to_array().map(f32::to_bits));
        if self.is_sky { SkyLight::new(RADIANCE).sample_li(p, u) } else { Panel.sample_li(p, u) }
    }
    fn pdf_li(&self, hit: &LightHit) -> f32 {
        let origin = hit.origin.to_array().map(f32::to_bits);
        let is_known = self.sampled.lock().unwrap().contains(&origin);
        self.densities[usize::from(is_known)].fetch_add(1, Ordering::Relaxed);
        if self.is_sky { SkyLight::new(RADIANCE).pdf_li(hit) } else { Panel.pdf_li(hit) }
    }
    fn le(&self, _hit: &LightHit) -> Spectrum {
        RADIANCE
    }
}

/// Samples and densities are for the same points: those of surfaces, not the origins that rays are moved to. Caught: the
/// origin of the ray, for lamps and for lights around the scene.
#[test]
fn densities_are_asked_for_the_points_of_samples() {
    for (is_sky, is_smooth) in [(false, false), (false, true), (true, false), (true, true)] {
        let (sampled, densities) = (Arc::default(), Arc::<[AtomicU64; 2]>::default());
        let light =
            Remembers { is_sky, sampled: Arc::clone(&sampled), densities: Arc::clone(&densities) };
        let mut ball = lumpy_ball(24);
        if is_smooth {
            ball.normals = ball.positions.iter().map(|p| p.normalize()).collect();
        }
        let scene = ball_over_floor().shape("ball", ball, "red");
        let scene = match is_sky {
            true => scene.light(light),
            false => scene.shape_with_light("panel", panel(), None, light),
        };
        let settings = independent(16, PathIntegrator::new(3));
        let view = chapter_view(UVec2::splat(24));
        render(&scene.build().unwrap(), &view, &settings, &RenderOptions::default()).unwrap();
        let [unknown, known] = [0, 1].map(|i: usize| densities[i].load(Ordering::Relaxed));
        let what = format!("sky {is_sky}, smooth {is_smooth}");
        assert_eq!(unknown, 0, "{what}: of {known}");
        assert!(known > 100, "{what}: {known}");
    }
}

/// A point light that remembers the sample values that it was given, and may tell a density that is not a number.
struct Delta {
    pdf: f32,
    others_than_zero: Arc<AtomicU64>,
}

impl Light for Delta {
    fn is_delta(&self) -> bool {
        true
    }
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        self.others_than_zero.fetch_add(u64::from(u != Vec2::ZERO), Ordering::Relaxed);
        let (wi, distance) = (Vec3::new(3.0, 5.0, -4.0) - p).normalize_and_length();
        let li = Spectrum::splat(100.0 / (distance * distance));
        Some(LightSample::from_point(li, wi, self.pdf, p + wi * distance))
    }
}

/// Where all lights are delta lights their samples are functions of the point alone; and a density that is NaN shows as samples
/// that are not finite. Caught: values of directions given to lights, in blocks after the first; samples of no density dropped
/// in silence.
#[test]
fn delta_lights_get_no_sample_values_and_densities_are_checked() {
    for pdf in [1.0, f32::NAN] {
        let others_than_zero = Arc::<AtomicU64>::default();
        let light = Delta { pdf, others_than_zero: Arc::clone(&others_than_zero) };
        let scene = ball_over_floor().light(light).build().unwrap();
        let settings = independent(16, PathIntegrator::new(3));
        let view = chapter_view(UVec2::splat(24));
        let rendered = render(&scene, &view, &settings, &RenderOptions::default()).unwrap();
        assert_eq!(others_than_zero.load(Ordering::Relaxed), 0);
        assert_eq!(rendered.non_finite > 0, pdf.is_nan(), "{}", rendered.non_finite);
    }
}
