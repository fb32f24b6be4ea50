//! What the render loop promises beside the picture: what it counts, what it keeps of first hits, that
//! it ends on request, and that lights with an extent get samples.

mod scenes;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use lobe::bxdf::{Arena, Bsdf};
use lobe::geometry::Frame;
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::integrator::DirectIntegrator;
use lobe::interaction::{Shading, SurfaceInteraction};
use lobe::light::{BoundingSphere, Light, LightSample};
use lobe::material::Material;
use lobe::render::{Rendered, Sampling, render_with};
use lobe::scene::{IntegratorSettings, SceneBuilder};
use lobe::texture::Texture;
use lobe::{
    MatteMaterial, PerspectiveSettings, PointLight, RenderOptions, RenderSettings, Scene, Spectrum,
    View, render,
};
use scenes::{Middle, ball_over_floor, chapter_view, floor, independent, view};

/// A floor at y = -2.
fn floor_of(material: MatteMaterial) -> SceneBuilder {
    Scene::builder().material("floor", material).shape("floor", floor(-2.0, 6.0), "floor")
}

/// Looks from the origin straight down, on 2 × 2 units of the floor.
fn from_above() -> View {
    let camera = PerspectiveSettings {
        look_at: Vec3::NEG_Y,
        up: Vec3::Z,
        fov: 2.0 * 0.5_f32.atan().to_degrees(),
        ..PerspectiveSettings::default()
    };
    view(&camera, UVec2::splat(16))
}

fn settings() -> RenderSettings {
    independent(4, IntegratorSettings::direct())
}

fn rendered(scene: SceneBuilder, view: &View) -> Rendered {
    let options = RenderOptions { layers: true, ..RenderOptions::default() };
    render(&scene.build().unwrap(), view, &settings(), &options).unwrap()
}

/// NaN on one half of the floor.
struct Half;

impl Texture<Spectrum> for Half {
    fn evaluate(&self, si: &SurfaceInteraction) -> Spectrum {
        Spectrum::splat(if si.p().x < 0.0 { f32::NAN } else { 0.5 })
    }
}

/// Lobes that are not numbers are counted by the Bsdf, once for the light and once for the albedo, and
/// shown black. Seen to fail with kd clamped whatever it is, and without the count for the albedo.
#[test]
fn reflectances_that_are_none_are_counted() {
    let light = PointLight::new(Vec3::ZERO, Spectrum::WHITE);
    let half = rendered(floor_of(MatteMaterial::new(Arc::new(Half))).light(light), &from_above());
    assert_eq!(half.counters.rejected, 2 * 16 * 8 * 4);
    assert_eq!(half.non_finite, 0);
    for (place, color) in half.picture.color.iter().enumerate() {
        assert_eq!(color.is_black(), place % 16 < 8, "pixel {place}");
    }
}

/// A light whose radiance is infinite: no pixel shows it, and each sample is counted. Seen to fail
/// without the film's test for finite samples.
#[test]
fn radiance_that_is_none_is_counted() {
    let light = PointLight::new(Vec3::ZERO, Spectrum::splat(f32::INFINITY));
    let bright = rendered(floor_of(MatteMaterial::new([0.5; 3])).light(light), &from_above());
    assert_eq!(bright.non_finite, 16 * 16 * 4);
    assert!(bright.picture.color.iter().all(|color| color.is_black()));
}

/// Breaks the shading frame in both ways that there are.
struct NoFrame;

impl Material for NoFrame {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        si.set_shading(Shading { n: Vec3::NAN, ..si.shading() });
        assert_eq!(si.shading_n(), Vec3::Y);
        Bsdf::new(Frame { n: Vec3::NAN, ..Frame::from_normal(Vec3::Y) }, si.n())
    }
}

/// A shading frame that is none stays out of the layers, which show the surface's own, and each is counted. Seen to
/// fail without the test of frames in `Bsdf::new`, and with a normal of NaN set.
#[test]
fn frames_that_are_none_are_counted() {
    let broken =
        rendered(floor_of(MatteMaterial::new([0.5; 3])).material("floor", NoFrame), &from_above());
    assert_eq!(broken.counters.rejected, 16 * 16 * 4);
    assert_eq!(broken.non_finite, 0);
    assert!(broken.picture.layers.unwrap().normal.iter().all(|n| *n == Vec3::Y));
}

/// No more threads take part than there are tiles. Seen to fail with the number that was asked for.
#[test]
fn threads_that_took_part_are_told() {
    let scene = floor_of(MatteMaterial::new([0.5; 3])).build().unwrap();
    for (asked, tile_size, expected) in [(7, 16, 1), (7, 8, 4), (2, 8, 2)] {
        let threads = std::num::NonZeroUsize::new(asked);
        let options = RenderOptions { threads, tile_size, ..RenderOptions::default() };
        let rendered = render(&scene, &from_above(), &settings(), &options).unwrap();
        assert_eq!(rendered.threads, expected);
    }
}

/// The floor's normal, albedo and distance: 2 / cos θ from above, within the pixel. Seen to fail with
/// the distance along the view, and with the albedo of Lambert's law divided by π.
#[test]
fn layers_hold_the_first_hits() {
    let layers = rendered(floor_of(MatteMaterial::new([0.2, 0.3, 0.9])), &from_above())
        .picture
        .layers
        .unwrap();
    for place in 0..256_u32 {
        let corner = UVec2::new(place % 16, place / 16);
        let distance = |p: UVec2| (p.as_vec2() / 8.0 - 1.0).extend(2.0).length();
        let corners = [UVec2::ZERO, UVec2::X, UVec2::Y, UVec2::ONE].map(|c| distance(corner + c));
        let near = corners.into_iter().fold(f32::INFINITY, f32::min);
        let far = corners.into_iter().fold(0.0, f32::max);
        let found = layers.depth[place as usize];
        assert!(found > near && found < far, "pixel {corner}: {found} outside {near}..{far}");
        assert_eq!(layers.normal[place as usize], Vec3::Y, "pixel {corner}");
        assert_eq!(layers.albedo[place as usize].to_array(), [0.2, 0.3, 0.9], "pixel {corner}");
    }
}

/// Where nothing is hit, all layers are zero. Seen to fail with a missed ray's infinite distance added.
#[test]
fn layers_are_zero_where_nothing_is() {
    let away =
        PerspectiveSettings { look_at: Vec3::Y, up: Vec3::Z, ..PerspectiveSettings::default() };
    let away = view(&away, UVec2::splat(16));
    let layers = rendered(floor_of(MatteMaterial::new([1.0; 3])), &away).picture.layers.unwrap();
    assert!(layers.depth.iter().all(|depth| *depth == 0.0));
    assert!(layers.normal.iter().all(|normal| *normal == Vec3::ZERO));
}

/// A render ends after the tile during which it is told to, and a request after the last tile comes too
/// late. Seen to fail with the request looked at only once, and with it looked at again at the end.
#[test]
fn cancelling_ends_a_render() {
    let (scene, view) = (ball_over_floor().build().unwrap(), chapter_view(UVec2::splat(64)));
    for (stop_at, expected_tiles) in [(1, 1), (5, 5), (64, 64)] {
        let cancel = AtomicBool::new(false);
        let tiles = AtomicU32::new(0);
        let progress = |_| {
            if tiles.fetch_add(1, Ordering::Relaxed) + 1 == stop_at {
                cancel.store(true, Ordering::Relaxed);
            }
        };
        let options = RenderOptions {
            threads: std::num::NonZeroUsize::new(1),
            tile_size: 8,
            progress: Some(&progress),
            cancel: Some(&cancel),
            ..RenderOptions::default()
        };
        let rendered = render(&scene, &view, &settings(), &options).unwrap();
        assert_eq!(tiles.load(Ordering::Relaxed), expected_tiles);
        assert_eq!(rendered.complete, stop_at == 64, "stopped at {stop_at}");
        assert_eq!(rendered.empty_pixels, u64::from(64 - stop_at) * 64);
    }
}

/// A square of side 2 at y = 0 over the middle of the floor, sampled over its area: a light with an
/// extent, as another crate would write one.
struct Panel;

impl Light for Panel {
    fn is_delta(&self) -> bool {
        false
    }
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        let from = Vec3::new(2.0 * u.x - 1.0, -0.5, 2.0 * u.y - 1.0);
        let to_light = from - p;
        let wi = to_light.normalize();
        // Solid angle of an area: dω = cos θ dA / d².
        let pdf = to_light.length_squared() / (4.0 * wi.y);
        Some(LightSample { li: Spectrum::WHITE, wi, pdf, from: Some(from) })
    }

    fn power(&self, _scene: &BoundingSphere) -> Option<Spectrum> {
        Some(Spectrum::WHITE)
    }
}

/// The irradiance under the middle of a parallel square, in closed form: with X = Y = a/h for half sides a
/// and distance h, four times a quarter's form factor,
/// F = 4/(2π) [X/√(1+X²) atan(Y/√(1+X²)) + Y/√(1+Y²) atan(X/√(1+Y²))] (Howell, configuration B-3).
/// Seen to fail when every light is sampled in its middle, and with 16 samples taken over and over.
#[test]
fn lights_with_an_extent_are_sampled() {
    let spp = 1 << 16;
    let tiny = PerspectiveSettings {
        eye: Vec3::new(0.0, -1.0, 0.0),
        look_at: Vec3::new(0.0, -2.0, 0.0),
        up: Vec3::Z,
        fov: 0.01,
        ..PerspectiveSettings::default()
    };
    let scene = floor_of(MatteMaterial::new([1.0; 3])).light(Panel).build().unwrap();
    let mut settings = independent(spp, IntegratorSettings::direct());
    settings.sampler.seed = 5;
    let tiny = view(&tiny, UVec2::ONE);
    let rendered = render(&scene, &tiny, &settings, &RenderOptions::default()).unwrap();
    let found = rendered.picture.color[0].to_array()[0];
    let x = 1.0 / 1.5_f64;
    let root = (1.0 + x * x).sqrt();
    let expected = 4.0 / std::f64::consts::TAU * 2.0 * (x / root) * (x / root).atan();
    // The weights lie between 0.3 and 1.2 of the mean: five standard errors are below 0.5 %.
    let error = (f64::from(found) / expected - 1.0).abs();
    assert!(error < 0.005, "{found} instead of {expected}");
}

/// A lens focused at an enormous distance is focused at infinity, and shows what is there. Seen to fail
/// with the point in focus computed as a product.
#[test]
fn focus_may_be_anywhere() {
    for focal_distance in [1e-3, 1.0, 1e10, 1e20, 1e38] {
        let camera = PerspectiveSettings {
            eye: Vec3::new(0.0, 2.0, 0.0),
            look_at: Vec3::ZERO,
            up: Vec3::Z,
            lens_radius: 1e-5,
            focal_distance,
            ..PerspectiveSettings::default()
        };
        let scene = Scene::builder()
            .material("floor", MatteMaterial::new([0.5; 3]))
            .shape("floor", floor(0.0, 100.0), "floor")
            .light(PointLight::new(Vec3::Y, Spectrum::WHITE))
            .build()
            .unwrap();
        let rendered = render_with(
            &scene,
            &view(&camera, UVec2::splat(4)),
            &DirectIntegrator::default(),
            Sampling::new(&Middle, 1),
            &RenderOptions::default(),
        );
        let color = rendered.unwrap().picture.color;
        assert!(color.iter().all(|c| !c.is_black()), "focused at {focal_distance}");
    }
}
