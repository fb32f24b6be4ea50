//! The render loop, apart from the picture: counters, layers of first hits, cancelling, passes, and samples for lights
//! with an extent.

mod scenes;

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use lobe::bxdf::{Arena, Bsdf};
use lobe::geometry::Frame;
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::integrator::{
    AlbedoIntegrator, ChapterIntegrator, DirectIntegrator, Estimator, Integrator, PathIntegrator,
    Wave,
};
use lobe::interaction::{Shading, SurfaceInteraction};
use lobe::light::{BoundingSphere, DistantLight, Light, LightSample, SkyLight};
use lobe::material::{Material, MetalMaterial, PlasticMaterial, Roughness};
use lobe::render::{RenderError, Rendered, SamplerSettings, Sampling, SettingsError, render_with};
use lobe::sampling::{IndependentSampler, Sampler, SamplerKind, SobolSampler};
use lobe::scene::SceneBuilder;
use lobe::texture::Texture;
use lobe::{
    MatteMaterial, PerspectiveSettings, PointLight, RenderOptions, RenderSettings, Scene, Spectrum,
    View, render,
};
use scenes::{
    Middle, ball_over_floor, chapter_view, floor, floor_of, from_above, independent, view,
};

fn settings() -> RenderSettings {
    independent(4, DirectIntegrator::default())
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

/// Lobe values that are not finite are counted by the Bsdf, once for the light and once for the albedo, and
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

/// Sets an invalid shading frame, in each of the two possible ways.
struct NoFrame;

impl Material for NoFrame {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        si.set_shading(Shading { n: Vec3::NAN, ..si.shading() });
        assert_eq!(si.shading_n(), Vec3::Y);
        Bsdf::new(Frame { n: Vec3::NAN, ..Frame::from_normal(Vec3::Y) }, si.n())
    }
}

/// An invalid shading frame is counted, and does not reach the layers, which show the surface's own. Seen to
/// fail without the test of frames in `Bsdf::new`, and with a normal of NaN set.
#[test]
fn frames_that_are_none_are_counted() {
    let broken =
        rendered(floor_of(MatteMaterial::new([0.5; 3])).material("floor", NoFrame), &from_above());
    assert_eq!(broken.counters.rejected, 16 * 16 * 4);
    assert_eq!(broken.non_finite, 0);
    assert!(broken.picture.layers.unwrap().normal.iter().all(|n| *n == Vec3::Y));
}

/// Shades with a frame of its own, which leans towards x.
struct Leaning;

const LEANING: Vec3 = Vec3::new(0.6, 0.8, 0.0);

impl Material for Leaning {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        Bsdf::new(Frame::from_normal(LEANING), si.n())
    }
}

/// The layer of normals has those that the surface is shaded with. Seen to fail with the normal of the triangle.
#[test]
fn normals_of_layers_are_those_of_shading() {
    let leaning =
        rendered(floor_of(MatteMaterial::new([0.5; 3])).material("floor", Leaning), &from_above());
    let layers = leaning.picture.layers.unwrap();
    assert!(layers.normal.iter().all(|n| (*n - LEANING).length() < 1e-6), "{:?}", layers.normal);
}

/// A mesh with vertex normals is shaded with them, though its material is one constant lobe: under light from above by the
/// cosine with the leaning normal. Seen to fail with such meshes shaded as flat ones.
#[test]
fn smooth_meshes_are_shaded_smoothly() {
    let mut mesh = floor(-2.0, 6.0);
    mesh.normals = vec![LEANING; 4];
    let scene = Scene::builder()
        .material("m", MatteMaterial::new([0.5; 3]))
        .shape("floor", mesh, "m")
        .light(DistantLight::new(Vec3::Y, Spectrum::WHITE).unwrap());
    let expected = 0.5 * 0.8 / std::f32::consts::PI;
    let color = rendered(scene, &from_above()).picture.color;
    assert!(color.iter().all(|c| (c.to_array()[0] - expected).abs() < 1e-6), "{color:?}");
}

/// No more threads run than there are tiles. Seen to fail with the number that was asked for.
#[test]
fn threads_that_took_part_are_told() {
    let scene = floor_of(MatteMaterial::new([0.5; 3])).build().unwrap();
    for (asked, tile_size, expected) in [(7, 16, 1), (7, 8, 4), (2, 8, 2)] {
        let threads = NonZeroUsize::new(asked);
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

/// The albedo of a glossy surface is what it returns of a sky of radiance 1: means over the picture agree within 4.5 standard errors
/// (significance 7e-6 a band), which are below 1.5e-3, and no pixel is off by 0.1 at 128 samples. Caught: the same directions for all
/// samples of a pixel; an event chosen by a value of its direction.
#[test]
fn albedo_is_what_a_sky_shows() {
    let copper = MetalMaterial::new([0.362, 1.015, 1.247].into(), [3.127, 2.579, 2.453].into());
    let plastic = PlasticMaterial::new(Spectrum::new(0.2, 0.5, 0.8), 1.5);
    let materials: [Arc<dyn Material>; 2] = [
        Arc::new(copper.with_roughness(Roughness::alpha(0.4))),
        Arc::new(plastic.with_roughness(Roughness::alpha(0.3))),
    ];
    for (trial, material) in materials.into_iter().enumerate() {
        let scene = Scene::builder()
            .material("floor", material)
            .shape("floor", floor(-2.0, 6.0), "floor")
            .light(SkyLight::new(Spectrum::splat(1.0)));
        let scene = scene.build().unwrap();
        let with = |spp, layers| {
            let integrator = DirectIntegrator::default();
            let settings = RenderSettings::new(
                SamplerSettings { spp, ..SamplerSettings::default() },
                integrator,
            );
            let options = RenderOptions { layers, ..RenderOptions::default() };
            render(&scene, &from_above(), &settings, &options).unwrap().picture
        };
        let (truth, layers) = (with(1024, false).color, with(128, true).layers.unwrap());
        for band in 0..3 {
            let differences = truth.iter().zip(&layers.albedo).map(|(truth, albedo)| {
                f64::from(albedo.to_array()[band]) - f64::from(truth.to_array()[band])
            });
            let differences: Vec<f64> = differences.collect();
            let n = differences.len() as f64;
            let mean = differences.iter().sum::<f64>() / n;
            let variance = differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0);
            let error = (variance / n).sqrt();
            assert!(error < 1.5e-3, "{trial}, band {band}: standard error {error}");
            assert!(
                mean.abs() < 4.5 * error,
                "{trial}, band {band}: {mean}, standard error {error}"
            );
            assert!(differences.iter().all(|d| d.abs() < 0.1), "{trial}, band {band}");
        }
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

/// A render that its progress callback cancels ends after that tile; a request after the last tile has no effect.
/// Seen to fail with the request looked at only once, and with it looked at again at the end.
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
            threads: NonZeroUsize::new(1),
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

/// Counts waves, and cancels the render in one of them.
struct CancelsInWave<'a> {
    inner: DirectIntegrator,
    waves: AtomicU32,
    number: u32,
    cancel: &'a AtomicBool,
}

impl Integrator for CancelsInWave<'_> {
    fn prepare<'a>(&'a self, scene: &'a Scene) -> Box<dyn Estimator + 'a> {
        Box::new(CancelsInWaveEstimator { inner: self.inner.prepare(scene), of: self })
    }
}

struct CancelsInWaveEstimator<'a> {
    inner: Box<dyn Estimator + 'a>,
    of: &'a CancelsInWave<'a>,
}

impl Estimator for CancelsInWaveEstimator<'_> {
    fn shade(&self, sampler: &dyn Sampler, wave: &mut Wave) {
        if self.of.waves.fetch_add(1, Ordering::SeqCst) + 1 == self.of.number {
            self.of.cancel.store(true, Ordering::SeqCst);
        }
        self.inner.shade(sampler, wave);
    }

    fn shadow_rays(&self) -> usize {
        self.inner.shadow_rays()
    }
}

/// No wave begins once a render is cancelled, however large tiles are: other threads end those that they are in. Seen
/// to fail with the request looked at before each tile.
#[test]
fn a_cancelled_render_ends_within_a_wave() {
    let scene = ball_over_floor().light(PointLight::new(Vec3::Y, Spectrum::WHITE)).build().unwrap();
    let sampler = IndependentSampler::new(0);
    // 16 waves in each of 16 tiles.
    for (threads, number) in [(1, 1), (1, 100), (1, 200), (1, 256), (3, 100)] {
        let cancel = AtomicBool::new(false);
        let inner = DirectIntegrator::default();
        let integrator = CancelsInWave { inner, waves: AtomicU32::new(0), number, cancel: &cancel };
        let options = RenderOptions {
            threads: NonZeroUsize::new(threads),
            tile_size: 32,
            cancel: Some(&cancel),
            ..RenderOptions::default()
        };
        let rendered = render_with(
            &scene,
            &chapter_view(UVec2::splat(128)),
            &integrator,
            Sampling::new(&sampler, 16),
            &options,
        )
        .unwrap();
        let waves = integrator.waves.into_inner();
        let most = number + threads as u32 - 1;
        assert!((number..=most).contains(&waves), "{threads} threads: {waves} of {most} waves");
        assert_eq!(rendered.counters.camera_rays, u64::from(waves) * 1024);
        assert!(!rendered.complete, "in wave {number}");
        if threads == 1 {
            // The last tile is cut, too: its wave was under way.
            let tiles = (u64::from(number) - 1) / 16;
            assert_eq!(rendered.empty_pixels, (16 - tiles) * 1024);
        }
    }
}

/// A cancelled render has its whole passes, and the tiles that its last pass finished. Passes of 1, 1, 2, 4 and 8 samples
/// here; tiles of 8 × 8 in rows of 8. Seen to fail with the tile of the request merged unfinished, and with the number
/// of samples of the pass that was cancelled.
#[test]
fn a_cancelled_render_returns_what_it_has() {
    let light = SkyLight::new(Spectrum::new(0.2, 0.4, 0.8));
    let (scene, view) =
        (ball_over_floor().light(light).build().unwrap(), chapter_view(UVec2::splat(64)));
    let mut settings = independent(16, PathIntegrator::new(3));
    settings.sampler.kind = SamplerKind::SOBOL;
    let options = RenderOptions {
        threads: NonZeroUsize::new(1),
        tile_size: 8,
        time: Some(Duration::MAX),
        layers: true,
        ..RenderOptions::default()
    };
    // Black, and the pictures of whole passes.
    let whole: Vec<_> = [1, 2, 4, 8, 16]
        .map(|spp| {
            let options = RenderOptions { spp: Some(spp), ..options };
            let rendered = render(&scene, &view, &settings, &options).unwrap();
            assert!(rendered.complete && rendered.samples_per_pixel == spp);
            rendered.picture.color
        })
        .into_iter()
        .collect();
    let colors = |pass: usize, place: usize| match pass {
        0 => Spectrum::BLACK,
        _ => whole[pass - 1][place],
    };
    for (passes, tiles) in [(0, 0), (0, 10), (1, 0), (2, 0), (2, 1), (2, 63), (3, 30), (4, 7)] {
        let cancel = AtomicBool::new(tiles == 0 && passes == 0);
        let done = AtomicU32::new(0);
        let stop_at = 64 * passes as u32 + tiles;
        let progress = |_| {
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            cancel.fetch_or(done == stop_at, Ordering::Relaxed);
        };
        let options = RenderOptions {
            spp: Some(16),
            progress: Some(&progress),
            cancel: Some(&cancel),
            ..options
        };
        let rendered = render(&scene, &view, &settings, &options).unwrap();
        let what = format!("cancelled after {passes} passes and {tiles} tiles");
        let samples_of = [0, 1, 2, 4, 8, 16];
        assert!(!rendered.complete, "{what}");
        assert_eq!(rendered.samples_per_pixel, samples_of[passes], "{what}");
        let empty = if passes == 0 { 64 * (64 - u64::from(tiles)) } else { 0 };
        assert_eq!(rendered.empty_pixels, empty, "{what}");
        let samples = rendered.picture.layers.unwrap().samples;
        for (place, color) in rendered.picture.color.into_iter().enumerate() {
            let tile = place / 64 / 8 * 8 + place % 64 / 8;
            let passes = passes + usize::from(tile < tiles as usize);
            assert_eq!(samples[place], samples_of[passes], "{what}, pixel {place}");
            assert_eq!(color, colors(passes, place), "{what}, pixel {place}");
        }
    }
}

/// The callback gets each pass as it ends, with the picture so far. It does not change the picture, and may cancel the
/// render. Seen to fail with the callback before the pass is counted, and with it called after a cancelled pass.
#[test]
fn passes_are_handed_over() {
    let light = SkyLight::new(Spectrum::WHITE);
    let (scene, view) =
        (ball_over_floor().light(light).build().unwrap(), chapter_view(UVec2::new(20, 15)));
    let settings = independent(7, PathIntegrator::new(3));
    let options = RenderOptions {
        time: Some(Duration::MAX),
        layers: true,
        spp: Some(7),
        ..RenderOptions::default()
    };
    let without = render(&scene, &view, &settings, &options).unwrap();
    let until = |stop_at: u32| {
        let (cancel, pictures) = (AtomicBool::new(false), Mutex::new(Vec::new()));
        let on_pass = |rendered: &Rendered| {
            assert!(!rendered.complete && rendered.empty_pixels == 0);
            cancel.store(rendered.samples_per_pixel == stop_at, Ordering::Relaxed);
            let picture = rendered.picture.clone();
            pictures.lock().unwrap().push((rendered.samples_per_pixel, picture));
        };
        let options = RenderOptions { on_pass: Some(&on_pass), cancel: Some(&cancel), ..options };
        let rendered = render(&scene, &view, &settings, &options).unwrap();
        (rendered, pictures.into_inner().unwrap())
    };
    let (rendered, pictures) = until(0);
    assert!(rendered.complete && rendered.picture == without.picture);
    assert_eq!(pictures.iter().map(|(spp, _)| *spp).collect::<Vec<_>>(), [1, 2, 4, 7]);
    assert!(pictures[3].1 == without.picture);
    for (spp, picture) in &pictures[..3] {
        let options = RenderOptions { spp: Some(*spp), ..options };
        assert!(render(&scene, &view, &settings, &options).unwrap().picture == *picture);
        let (rendered, seen) = until(*spp);
        assert!(!rendered.complete && rendered.samples_per_pixel == *spp);
        assert!(rendered.picture == *picture && seen.last().unwrap().0 == *spp);
    }
}

/// Zero samples are an error.
#[test]
fn no_samples_are_an_error() {
    let (scene, view) = (Scene::builder().build().unwrap(), from_above());
    let none = RenderOptions { spp: Some(0), ..RenderOptions::default() };
    let expected = RenderError::Settings(SettingsError::NoSamples);
    for (spp, options) in [(0, RenderOptions::default()), (4, none)] {
        let settings = independent(spp, DirectIntegrator::default());
        assert_eq!(render(&scene, &view, &settings, &options).err(), Some(expected));
        let integrator = DirectIntegrator::default();
        let sampling = Sampling::new(&Middle, spp);
        let rendered = render_with(&scene, &view, &integrator, sampling, &options);
        assert_eq!(rendered.err(), Some(expected));
    }
}

/// A square of side 2 at y = 0 over the middle of the floor, sampled by area: a light with an extent, written as
/// in another crate.
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
        Some(LightSample::from_point(Spectrum::WHITE, wi, pdf, from))
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
    let mut settings = independent(spp, DirectIntegrator::default());
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

/// Shades the first column of the image as not finite.
struct BlindColumn;

impl Integrator for BlindColumn {
    fn prepare<'a>(&'a self, _: &'a Scene) -> Box<dyn Estimator + 'a> {
        Box::new(Self)
    }
}

impl Estimator for BlindColumn {
    fn shade(&self, _: &dyn Sampler, wave: &mut Wave) {
        for (id, radiance) in wave.ids.iter().zip(&mut wave.radiance) {
            *radiance = Spectrum::splat(if id.pixel.x == 0 { f32::NAN } else { 1.0 });
        }
    }

    fn shadow_rays(&self) -> usize {
        0
    }
}

/// Seen to fail with only those pixels counted that a cancelled render did not reach.
#[test]
fn pixels_whose_samples_are_all_left_out_are_empty() {
    let scene = Scene::builder().build().unwrap();
    let view = chapter_view(UVec2::new(20, 15));
    let settings = independent(4, BlindColumn);
    let rendered = render(&scene, &view, &settings, &RenderOptions::default()).unwrap();
    assert_eq!((rendered.empty_pixels, rendered.non_finite), (15, 60));
    assert_eq!(rendered.picture.color[0], Spectrum::BLACK);
    assert_eq!(rendered.picture.color[1], Spectrum::WHITE);
}

/// Sets beyond the number of samples would be empty, and take memory. Seen to fail with room made for all of them.
#[test]
fn there_are_no_more_sets_than_samples() {
    let scene = floor_of(MatteMaterial::new([0.5; 3])).light(SkyLight::new(Spectrum::WHITE));
    let (scene, sampler) = (scene.build().unwrap(), SobolSampler::new(0));
    let of = |sets| {
        let sampling = Sampling { sampler: &sampler, spp: 2, sets };
        let options = RenderOptions { layers: true, ..RenderOptions::default() };
        let integrator = DirectIntegrator::default();
        render_with(&scene, &from_above(), &integrator, sampling, &options).unwrap().picture
    };
    assert!(of(u32::MAX) == of(2));
}

/// Samples are divided into as many sets as were asked for, up to 1024, and up to one for each sample. Seen to fail without
/// the first limit, and with sets of equal size only, of which 7 samples have one.
#[test]
fn sets_are_as_many_as_asked_for() {
    let of = |kind, spp, replicates| SamplerSettings { kind, spp, seed: 0, replicates }.sets();
    assert_eq!(of(SamplerKind::SOBOL, 4096, 4096), SamplerSettings::MAX_SETS);
    assert_eq!(of(SamplerKind::SOBOL, 12, 5), 5);
    assert_eq!(of(SamplerKind::SOBOL, 7, 2), 2);
    assert_eq!(of(SamplerKind::SOBOL, 3, 8), 3);
    assert_eq!(of(SamplerKind::SOBOL, 8, 0), 1);
    assert_eq!(of(SamplerKind::INDEPENDENT, 8, 4), 1);
}

/// The camera's pixels reach the textures: far away, one sample a pixel shows the mean of an image, in the picture, in the layer of the albedo, and
/// in the pictures of the integrators that shade hits one by one. Seen to fail with a camera that is not known to them, each in turn.
#[test]
fn far_images_are_filtered() {
    use lobe::image::{Encoding, Image};
    use lobe::texture::{Curve, ImageTexture, Mapping, Minification, Projection, Texels};
    let pixels = (0..64 * 64).map(|i| Spectrum::splat((i % 64 / 32 + i / 64 / 32) as f32 % 2.0));
    let (size, pixels, encoding) = (UVec2::splat(64), pixels.collect(), Encoding::Linear);
    let image = Image { size, pixels, variance: None, degrees_of_freedom: None, encoding };
    let texels = Arc::new(Texels::new(&image, Curve::Linear).unwrap());
    let upright = lobe::glam::Quat::from_rotation_x(std::f32::consts::FRAC_PI_2);
    // 50 images in a pixel.
    let mapping =
        Mapping::new(Projection::Planar).placed(Vec3::ZERO, upright).scaled(Vec2::splat(400.0));
    let errors = |minification| {
        let image =
            ImageTexture::new(texels.clone()).with_mapping(mapping).with_minification(minification);
        let texture = image.into_handle();
        let scene =
            floor_of(MatteMaterial::new(texture.clone())).light(SkyLight::new(Spectrum::WHITE));
        let picture = rendered(scene, &from_above()).picture;
        let light = DistantLight::new(Vec3::Y, Spectrum::WHITE).unwrap();
        let lit = floor_of(MatteMaterial::new(texture)).light(light).build().unwrap();
        let of = |integrator: Arc<dyn Integrator>| {
            let settings = RenderSettings { integrator, ..settings() };
            let options = RenderOptions::default();
            render(&lit, &from_above(), &settings, &options).unwrap().picture.color
        };
        // From a brightness of 3 R / π².
        let pi2 = std::f32::consts::PI * std::f32::consts::PI;
        let chapter = of(Arc::new(ChapterIntegrator::default()));
        let chapter = chapter.iter().map(|color| *color * (pi2 / 3.0)).collect();
        let albedo = of(Arc::new(AlbedoIntegrator));
        [picture.color, picture.layers.unwrap().albedo, albedo, chapter].map(|color| {
            color.iter().map(|color| (color.to_array()[0] - 0.5).abs()).fold(0.0, f32::max)
        })
    };
    let (filtered, single) = (errors(Minification::Anisotropic), errors(Minification::None));
    assert!(filtered.iter().all(|error| *error < 0.02), "{filtered:?}");
    assert!(single.iter().all(|error| *error > 0.15), "{single:?}");
}
