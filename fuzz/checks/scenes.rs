//! What holds for any OBJ file, scene file and override: an error in one plain line, or something sound.

use std::num::NonZeroUsize;
use std::path::Path;

use lobe::render::RenderError;
use lobe::scene_file::{LoadedScene, SceneFileError, parse_scene};
use lobe::{RenderOptions, Spectrum, render};

/// Any bytes as an OBJ file: an error, or a mesh that keeps its promises.
pub fn obj(bytes: &[u8]) {
    match lobe::shape::parse_obj("fuzz.obj", bytes) {
        Ok(read) => {
            read.mesh.check().expect("what is read is sound");
            assert!(!read.mesh.indices.is_empty());
            let report = read.report;
            for skipped in [report.short_faces, report.unknown_lines] {
                assert_eq!(skipped.count == 0, skipped.first == 0, "{report:?}");
            }
            assert!(report.unused_vertices <= read.mesh.positions.len(), "{report:?}");
            assert!(report.degenerate_triangles <= read.mesh.indices.len(), "{report:?}");
        }
        Err(error) => assert_plain(&error.to_string(), &["fuzz.obj:"]),
    }
}

/// Any text as a scene file: an error that names the place, or a scene whose picture is finite.
pub fn scene(text: &str) {
    let parse = |overrides: &[&str]| parse_scene(Path::new("fuzz.toml"), text, overrides);
    if let Err(error) = parse(&[]) {
        return assert_plain(&error.to_string(), &["fuzz.toml:"]);
    }
    let small = ["film.resolution=[8, 8]", "film.crop=[0, 0, 8, 8]", "integrator.max_depth=3"];
    // Integrators without a depth refuse its key.
    assert_sound(parse(&small).or_else(|_| parse(&small[..2])));
}

/// Any text as an override of a small scene: an error that names it, or a scene whose picture is finite.
pub fn overrides(text: &str) {
    let small = ["film.resolution=[8, 8]", "film.crop=[0, 0, 8, 8]", "integrator.max_depth=3"];
    let parse = |overrides: &[&str]| parse_scene(Path::new("fuzz.toml"), SMALL, overrides);
    if let Err(error) = parse(&[text]) {
        return assert_plain(&error.to_string(), &["--set ", "fuzz.toml:"]);
    }
    let all: Vec<&str> = [text].into_iter().chain(small).collect();
    assert_sound(parse(&all).or_else(|_| parse(&all[..3])));
}

/// A scene with something of every table.
const SMALL: &str = r#"
[camera]
eye = [0, 1, -3]
[film]
resolution = [8, 8]
[sampler]
spp = 1
[integrator]
max_depth = 2
[texture.red]
type = "constant"
value = [0.8, 0.1, 0.1]
[material.clay]
type = "matte"
kd = "red"
[light.key]
type = "point"
position = [0, 3, -3]
intensity = [9, 9, 9]
[shape.floor]
type = "rectangle"
material = "clay"
corner = [-5, 0, -5]
edges = [[0, 0, 10], [10, 0, 0]]
[shape.lamp]
type = "rectangle"
emission = [1, 2, 3]
corner = [-1, 2, -1]
edges = [[2, 0, 0], [0, 0, 2]]
"#;

/// Renders one sample per pixel, with all layers. Everything in the picture is finite.
fn assert_sound(loaded: Result<LoadedScene, SceneFileError>) {
    let LoadedScene { scene, view, settings, .. } = match loaded {
        Ok(loaded) => loaded,
        Err(error) => return assert_plain(&error.to_string(), &["--set ", "fuzz.toml:"]),
    };
    let options = RenderOptions {
        threads: NonZeroUsize::new(1),
        spp: Some(1),
        layers: true,
        ..RenderOptions::default()
    };
    let rendered: Result<_, RenderError> = render(&scene, &view, &settings, &options);
    let picture = match rendered {
        Ok(rendered) => rendered.picture,
        Err(error) => return assert_plain(&error.to_string(), &[""]),
    };
    let is_finite = |colors: &[Spectrum]| {
        colors.iter().flat_map(|color| color.to_array()).all(|band| band.is_finite())
    };
    assert!(is_finite(&picture.color), "colours: {:?}", picture.color);
    let layers = picture.layers.expect("layers were asked for");
    assert!(is_finite(&layers.albedo), "albedo: {:?}", layers.albedo);
    assert!(layers.normal.iter().all(|normal| normal.is_finite()), "{:?}", layers.normal);
    assert!(layers.depth.iter().all(|depth| depth.is_finite()), "{:?}", layers.depth);
}

/// A message is one line that begins with its place, without control characters, and short enough to read.
fn assert_plain(message: &str, beginnings: &[&str]) {
    assert!(beginnings.iter().any(|place| message.starts_with(place)), "{message}");
    assert!(!message.chars().any(char::is_control), "{message:?}");
    assert!(message.chars().count() < 6000, "{message}");
}
