//! The picture is the same, bit by bit, however the work is cut and whoever does it.

mod scenes;

use std::num::NonZeroUsize;

use lobe::film::{Metadata, Picture, Window, write_exr};
use lobe::glam::{UVec2, Vec3};
use lobe::scene::{IntegratorSettings, SamplerKind, SamplerSettings, SceneBuilder};
use lobe::{CameraSettings, PointLight, RenderOptions, Spectrum, render};
use scenes::{ball_over_floor, chapter_camera};

const RESOLUTION: UVec2 = UVec2::new(53, 37);

/// A scene that uses all there is: a lens, shadows, two lights, first-hit layers.
fn scene(kind: SamplerKind) -> SceneBuilder {
    ball_over_floor(RESOLUTION)
        .camera(CameraSettings { lens_radius: 0.2, focal_distance: 4.0, ..chapter_camera() })
        .sampler(SamplerSettings { kind, spp: 5, seed: 7, ..Default::default() })
        .integrator(IntegratorSettings::direct())
        .light(PointLight::new(Vec3::new(10.0, 10.0, -10.0), Spectrum::splat(900.0)))
        .light(PointLight::new(Vec3::new(-5.0, 3.0, 1.0), Spectrum::new(0.0, 20.0, 40.0)))
}

fn picture(builder: SceneBuilder, threads: usize, tile_size: u32) -> Picture {
    let options = RenderOptions {
        threads: NonZeroUsize::new(threads),
        tile_size,
        layers: true,
        ..RenderOptions::default()
    };
    render(&builder.build().unwrap(), &options).unwrap().picture
}

/// Seen to fail with pixels counted from the corner of their tile.
#[test]
fn threads_and_tiles_do_not_matter() {
    let folder = std::env::temp_dir().join(format!("lobe-determinism-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    for kind in [SamplerKind::Independent, SamplerKind::Stratified] {
        let mut expected = None;
        for (threads, tile_size) in
            [(1, 16), (2, 16), (7, 16), (1, 1), (2, 7), (7, 64), (2, 100_000)]
        {
            let path = folder.join(format!("{threads}-{tile_size}.exr"));
            let picture = picture(scene(kind), threads, tile_size);
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

/// Seen to fail with pixels counted from the corner of the crop.
#[test]
fn crop_is_a_part_of_the_whole() {
    let whole = picture(scene(SamplerKind::Independent), 2, 16);
    let window = Window { min: UVec2::new(11, 5), max: UVec2::new(40, 36) };
    let crop = picture(scene(SamplerKind::Independent).crop(window), 2, 7);
    assert_eq!(crop.color.len(), window.area());
    let whole_layers = whole.layers.unwrap();
    let crop_layers = crop.layers.unwrap();
    for (place, y) in (window.min.y..window.max.y).enumerate() {
        let width = window.size().x as usize;
        let part = place * width..(place + 1) * width;
        let start = (y * RESOLUTION.x + window.min.x) as usize;
        assert_eq!(crop.color[part.clone()], whole.color[start..start + width], "row {y}");
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
        assert_eq!(crop_layers.albedo[part], whole_layers.albedo[start..start + width], "row {y}");
    }
}

/// Another seed gives another picture, the same one the same. Seen to fail when the seed is left out
/// of the hash.
#[test]
fn seed_decides() {
    let with = |seed| {
        let sampler = SamplerSettings { spp: 2, seed, ..Default::default() };
        picture(scene(SamplerKind::Independent).sampler(sampler), 2, 16).color
    };
    assert_eq!(with(1), with(1));
    assert_ne!(with(1), with(2));
}
