//! The picture is the same, bit by bit, for any threads, tiles and crop.

mod scenes;

use std::num::NonZeroUsize;
use std::time::Duration;

use lobe::accel::InstructionSet;
use lobe::film::GaussianFilter;
use lobe::glam::{UVec2, Vec3};
use lobe::image::{Metadata, Picture, Window, write_exr};
use lobe::integrator::PathIntegrator;
use lobe::light::SkyLight;
use lobe::render::SamplerSettings;
use lobe::sampling::SamplerKind;
use lobe::scene::Emission;
use lobe::{
    FilmSettings, PerspectiveSettings, PointLight, RenderOptions, RenderSettings, Scene, Spectrum,
    TriangleMesh, View, render,
};
use scenes::{ball_over_floor, chapter_camera};

const SAMPLERS: [SamplerKind; 4] = [
    SamplerKind::INDEPENDENT,
    SamplerKind::STRATIFIED,
    SamplerKind::SOBOL,
    SamplerKind::BLUE_NOISE,
];

const RESOLUTION: UVec2 = UVec2::new(53, 37);

/// Lights of all kinds. The render also uses a lens, a wide filter, reflections, sets of samples, and layers.
fn scene() -> Scene {
    scene_for(InstructionSet::fastest())
}

fn scene_for(set: InstructionSet) -> Scene {
    let lamp = TriangleMesh::parallelogram(Vec3::new(1.2, 1.5, -1.0), Vec3::X, Vec3::Z);
    ball_over_floor()
        .instruction_set(set)
        .lamp("lamp", lamp, Emission { radiance: Spectrum::splat(3.0), two_sided: true })
        .light(SkyLight::new(Spectrum::new(0.1, 0.2, 0.3)))
        .light(PointLight::new(Vec3::new(10.0, 10.0, -10.0), Spectrum::splat(900.0)))
        .light(PointLight::new(Vec3::new(-5.0, 3.0, 1.0), Spectrum::new(0.0, 20.0, 40.0)))
        .build()
        .unwrap()
}

fn view(crop: Option<Window>) -> View {
    let camera = PerspectiveSettings { lens_radius: 0.2, focal_distance: 4.0, ..chapter_camera() };
    let film = FilmSettings { resolution: RESOLUTION, crop, ..FilmSettings::default() };
    View::perspective(&camera, film.with_filter(GaussianFilter::default())).unwrap()
}

fn settings(kind: SamplerKind, spp: u32, seed: u64) -> RenderSettings {
    let sampler = SamplerSettings { kind, spp, seed, ..Default::default() };
    RenderSettings::new(sampler, PathIntegrator::new(5))
}

fn picture(view: &View, settings: &RenderSettings, threads: usize, tile_size: u32) -> Picture {
    picture_of(&scene(), view, settings, threads, tile_size)
}

fn picture_of(
    scene: &Scene,
    view: &View,
    settings: &RenderSettings,
    threads: usize,
    tile_size: u32,
) -> Picture {
    let options = RenderOptions {
        threads: NonZeroUsize::new(threads),
        tile_size,
        layers: true,
        ..RenderOptions::default()
    };
    render(scene, view, settings, &options).unwrap().picture
}

/// Rays find the same hits with all instruction sets of the processor. Seen to fail with a builder that forgets the choice,
/// and with AVX2 vectors whose `min` takes the larger number.
#[test]
fn instruction_sets_do_not_matter() {
    let (view, settings) = (view(None), settings(SamplerKind::SOBOL, 6, 7));
    let expected = picture(&view, &settings, 1, 16);
    for set in InstructionSet::available() {
        let scene = scene_for(set);
        assert_eq!(scene.accel().instruction_set(), set);
        assert!(picture_of(&scene, &view, &settings, 1, 16) == expected, "{set}");
    }
}

/// Seen to fail with pixels counted from the corner of their tile.
#[test]
fn threads_and_tiles_do_not_matter() {
    let folder = std::env::temp_dir().join(format!("lobe-determinism-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    for kind in SAMPLERS {
        let mut expected = None;
        for (threads, tile_size) in
            [(1, 16), (2, 16), (7, 16), (1, 1), (2, 7), (7, 64), (2, 100_000)]
        {
            let path = folder.join(format!("{threads}-{tile_size}.exr"));
            let picture = picture(&view(None), &settings(kind, 6, 7), threads, tile_size);
            write_exr(&path, &picture, &Metadata::default()).unwrap();
            let bytes = std::fs::read(&path).unwrap();
            let expected = expected.get_or_insert_with(|| bytes.clone());
            assert!(
                *expected == bytes,
                "{threads} threads and tiles of {tile_size} give another file"
            );
        }
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

/// Seen to fail with pixels counted from the corner of the crop, and with variances pooled in rows of the image's width.
#[test]
fn crop_is_a_part_of_the_whole() {
    for kind in SAMPLERS {
        let settings = settings(kind, 6, 7);
        let whole = picture(&view(None), &settings, 2, 16);
        let window = Window { min: UVec2::new(11, 5), max: UVec2::new(40, 36) };
        let crop = picture(&view(Some(window)), &settings, 2, 7);
        assert_eq!(crop.color.len(), window.area());
        let whole_layers = whole.layers.unwrap();
        let crop_layers = crop.layers.unwrap();
        let (whole_variance, crop_variance) = (whole.variance.unwrap(), crop.variance.unwrap());
        for (place, y) in (window.min.y..window.max.y).enumerate() {
            let width = window.size().x as usize;
            let part = place * width..(place + 1) * width;
            let start = (y * RESOLUTION.x + window.min.x) as usize;
            assert_eq!(crop.color[part.clone()], whole.color[start..start + width], "row {y}");
            // At its border a crop lacks neighbours to pool with.
            if y > window.min.y && y + 1 < window.max.y {
                let inner = part.start + 1..part.end - 1;
                assert_eq!(crop_variance[inner], whole_variance[start + 1..start + width - 1]);
            }
            assert_eq!(
                crop_layers.normal[part.clone()],
                whole_layers.normal[start..start + width],
                "row {y}"
            );
            assert_eq!(
                crop_layers.depth[part.clone()],
                whole_layers.depth[start..start + width],
                "row {y}"
            );
            assert_eq!(
                crop_layers.albedo[part],
                whole_layers.albedo[start..start + width],
                "row {y}"
            );
        }
    }
}

/// Several passes together take the same samples as one pass.
#[test]
fn passes_add_up_to_one() {
    for kind in SAMPLERS {
        let rendered = |time| {
            let options = RenderOptions { time, spp: Some(16), layers: true, ..Default::default() };
            render(&scene(), &view(None), &settings(kind, 16, 0), &options).unwrap()
        };
        let (one, many) = (rendered(None), rendered(Some(Duration::from_secs(1 << 20))));
        assert_eq!((one.samples_per_pixel, many.samples_per_pixel), (16, 16));
        assert_eq!(one.counters, many.counters);
        // Sums of f64 in another order.
        let pixels = one.picture.color.iter().zip(&many.picture.color);
        for (a, b) in pixels.flat_map(|(a, b)| a.to_array().into_iter().zip(b.to_array())) {
            assert!((a - b).abs() <= 2e-7 * a, "{kind:?}: {a}, {b}");
        }
    }
}

/// Another seed gives another picture, the same one the same. Seen to fail when the seed is left out
/// of the hash.
#[test]
fn seed_decides() {
    let with =
        |seed| picture(&view(None), &settings(SamplerKind::INDEPENDENT, 2, seed), 2, 16).color;
    assert_eq!(with(1), with(1));
    assert_ne!(with(1), with(2));
}
