//! Scene files: TOML, from the text to a [`Description`](description::Description) to a [`LoadedScene`].

mod build;
mod describe;
mod description;
mod document;
mod error;
mod hint;
mod overrides;
mod section;
mod tree;
mod value;

use std::path::Path;

pub use error::{Place, Problem, SceneFileError};

use super::{RenderSettings, Scene, View};
use crate::clock::Stopwatch;
use crate::shape::ObjReport;
use document::Document;

/// A scene that was read from a file.
pub struct LoadedScene {
    /// What is rendered.
    pub scene: Scene,
    /// How it is seen.
    pub view: View,
    /// How it is sampled and lit.
    pub settings: RenderSettings,
    /// What was noticed on the way.
    pub report: LoadReport,
}

/// What reading a scene took, and what is odd about its meshes.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct LoadReport {
    /// Wall-clock time in seconds, without the building of the tree.
    pub seconds: f64,
    /// What is odd about each mesh, in the order of [`Scene::shapes`].
    pub meshes: Vec<ObjReport>,
}

/// Reads the scene file at `path` with `overrides`. See [`parse_scene`].
///
/// # Errors
/// If the file cannot be read, or for what [`parse_scene`] refuses. The messages name the file by
/// `path`.
pub fn read_scene(path: &Path, overrides: &[&str]) -> Result<LoadedScene, SceneFileError> {
    let start = Stopwatch::start();
    let text = read_text(path)?;
    let mut loaded = parse_scene(path, &text, overrides)?;
    loaded.report.seconds = start.seconds() - loaded.scene.build_seconds();
    Ok(loaded)
}

/// The settings of the scene file at `path` with `overrides`, without its meshes being read.
///
/// # Errors
/// As for [`read_scene`], but for what is wrong with names and meshes.
pub fn read_settings(path: &Path, overrides: &[&str]) -> Result<RenderSettings, SceneFileError> {
    let text = read_text(path)?;
    let document = Document::parse(path, &text, overrides)?;
    let description = document.place(describe::describe(&document))?;
    Ok(RenderSettings { sampler: description.sampler, integrator: description.integrator })
}

fn read_text(path: &Path) -> Result<String, SceneFileError> {
    let unreadable = |source| SceneFileError::Unreadable { path: path.to_owned(), source };
    String::from_utf8(std::fs::read(path).map_err(unreadable)?).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        let place = document::file_place(path, error.as_bytes(), offset);
        SceneFileError::Wrong { place, problem: Problem::Toml("the text is not UTF-8".into()) }
    })
}

/// Makes a scene from the text of a scene file, and from the meshes it names.
///
/// `path` stands for the file in messages; it need not exist. Names of OBJ files are relative to its
/// folder.
///
/// Each of `overrides` is `KEY=VALUE` in TOML, such as `camera.fov=40`, and replaces or adds that
/// value; later ones win. An OBJ file that it names is relative to the current directory. It cannot
/// add a texture, material, light or shape.
///
/// # The format
/// Every table and every key may be left out unless it is said to be required; one that is not known
/// is an error. Lengths are in scene units, in the left-handed space of the [camera](crate::camera).
/// All numbers are finite.
///
/// | table | key | value | default |
/// |---|---|---|---|
/// | `[camera]` | `eye` | where it stands, `[x, y, z]` | origin |
/// | | `look_at` | a point in the middle of the image | `[0, 0, 1]` |
/// | | `up` | what is up in the image | `[0, 1, 0]` |
/// | | `fov` | degrees across the shorter side, above 0, below 180 | 90 |
/// | | `lens_radius` | 0 for a pinhole | 0 |
/// | | `focal_distance` | of the plane in focus, above 0 | 1 |
/// | `[film]` | `resolution` | `[columns, rows]` | `[500, 500]` |
/// | | `crop` | the part to render, `[x0, y0, x1, y1]` without column x1 and row y1 | all |
/// | | `display` | the curve of a PNG: `"srgb"`, or `"exposure"` for 1 - exp(-4 L) | `"srgb"` |
/// | | `filter` | `"box"`, `"tent"`, `"gaussian"` or `"blackman-harris"` | `"box"` |
/// | | `filter_radius` | in pixels, above 0 and up to 16, for all but `"box"` | 1 (tent), 1.5 |
/// | | `filter_sigma` | in pixels, above 0, for `"gaussian"` | 0.5 |
/// | `[sampler]` | `type` | `"independent"`, `"stratified"`, `"sobol"` or `"blue-noise"` | `"sobol"` |
/// | | `spp` | samples per pixel, at least 1 | 64 |
/// | | `seed` | each gives other samples | 0 |
/// | | `replicates` | sets to tell the error from, for all but `"independent"`; of them the largest number that divides `spp` | 2 |
/// | `[integrator]` | `type` | `"chapter"`, `"direct"` or `"path"` | `"path"` |
/// | | `highlight` | for `"chapter"`: whether to add the Blinn-Phong factor | false |
/// | | `max_depth` | for `"path"`: the most reflections; light that takes more is missing | 5 |
/// | | `roulette` | for `"path"`: whether paths that carry little end at random | true |
/// | | `strategy` | for `"direct"` and `"path"`: how light is looked for, `"auto"`, `"mis"`, `"light"` or `"bsdf"` | `"auto"` |
/// | `[texture.NAME]` | `type` | `"constant"` | required |
/// | | `value` | a number or `[red, green, blue]` | required |
/// | `[material.NAME]` | `type` | `"matte"` | required |
/// | | `kd` | reflected share, `[red, green, blue]` from 0 to 1 | 0.5 |
/// | | `sigma` | roughness in degrees, 0 to 90 | 0 |
/// | | `bump` | displacement along the normal | none |
/// | `[light.NAME]` | `type` | `"point"`, `"distant"` or `"sky"` | required |
/// | | `position` | of `"point"`, `[x, y, z]` | required |
/// | | `intensity` | of `"point"`, in W / sr, `[red, green, blue]` of at least 0 | required |
/// | | `direction` | of `"distant"`: where the light goes, `[x, y, z]` of any length | required |
/// | | `irradiance` | of `"distant"`: on a surface across it, in W / m², as above | required |
/// | | `radiance` | of `"sky"`: from everywhere, in W / (m² sr), as above | required |
/// | `[shape.NAME]` | `type` | `"obj"` or `"rectangle"` | `"obj"` |
/// | | `obj` | of `"obj"`: path of an OBJ file | required |
/// | | `corner` | of `"rectangle"`, `[x, y, z]` | required |
/// | | `edges` | of `"rectangle"`: two `[x, y, z]` from there; their cross product points outside | required |
/// | | `material` | a material's name; a shape with `emission` may do without, and reflects nothing | required |
/// | | `emission` | radiance that it sends out, in W / (m² sr), `[red, green, blue]` of at least 0 | none |
/// | | `two_sided` | whether it does so on both sides, or outside alone | false |
/// | | `scale` | a factor other than 0, or `[x, y, z]` | 1 |
/// | | `rotate` | `[x, y, z, degrees]`: around that axis, about +z from x to y | none |
/// | | `translate` | `[x, y, z]` | none |
///
/// `kd`, `sigma` and `bump` are values in place or names of textures. A shape is first scaled, then
/// rotated, then translated.
///
/// ```
/// use lobe::scene::parse_scene;
///
/// let text = "[camera]\nfvo = 40\n";
/// let error = parse_scene("scene.toml".as_ref(), text, &[]).err().unwrap();
/// assert_eq!(
///     error.to_string(),
///     "scene.toml:2:1: unknown key `fvo` in [camera]; did you mean `fov`?"
/// );
///
/// let loaded = parse_scene("scene.toml".as_ref(), "[sampler]\nspp = 4", &["sampler.seed=7"])?;
/// assert_eq!(loaded.settings.sampler.seed, 7);
/// # Ok::<(), lobe::scene::SceneFileError>(())
/// ```
///
/// # Errors
/// The first thing that is wrong, with its line and column or its override.
pub fn parse_scene(
    path: &Path,
    text: &str,
    overrides: &[&str],
) -> Result<LoadedScene, SceneFileError> {
    let start = Stopwatch::start();
    let document = Document::parse(path, text, overrides)?;
    let description = document.place(describe::describe(&document))?;
    let (scene, view, settings, meshes) = document.place(build::build(description, &document))?;
    let seconds = start.seconds() - scene.build_seconds();
    Ok(LoadedScene { scene, view, settings, report: LoadReport { seconds, meshes } })
}
