//! Scene files: TOML with overrides, errors with line and column, and the scene that comes of it.
//!
//! The text becomes a [`params`](crate::params) tree, whose tables are read by the registries of their rooms:
//! [`SECTIONS`] says which. [docs/scene-format.md] lists all of them with their keys; `lobe help scene-format` prints it.
//!
//! [docs/scene-format.md]: https://docs.rs/crate/lobe/latest/source/docs/scene-format.md

mod assemble;
mod document;
mod error;
mod overrides;
mod sections;
mod toml_tree;

use std::path::Path;

pub use error::{Place, SceneFileError, TextProblem};
pub use sections::SECTIONS;

use crate::clock::Stopwatch;
use crate::params::{Fault, Mark};
use crate::render::RenderSettings;
use crate::scene::{Scene, View};
use crate::shape::ObjReport;
use document::Source;

/// A scene that was read from a file.
pub struct LoadedScene {
    /// The scene.
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

/// How the scene file at `path` with `overrides` wants to be sampled and lit. No mesh is read.
///
/// # Errors
/// As for [`read_scene`], but for what is wrong with names and meshes.
pub fn read_settings(path: &Path, overrides: &[&str]) -> Result<RenderSettings, SceneFileError> {
    let text = read_text(path)?;
    let source = Source::new(path, &text, overrides);
    let description = source.place(assemble::describe(&source.parse()?))?;
    Ok(description.settings)
}

fn read_text(path: &Path) -> Result<String, SceneFileError> {
    let unreadable = |source| SceneFileError::Unreadable { path: path.to_owned(), source };
    String::from_utf8(std::fs::read(path).map_err(unreadable)?).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        let place = document::file_place(path, error.as_bytes(), offset);
        let problem = TextProblem::Toml("the text is not UTF-8".into());
        SceneFileError::Wrong { place, problem: Fault::new(Mark::default(), problem).problem }
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
/// Every table and every key may be left out unless it is said to be required; one that is not known is an error.
/// `docs/scene-format.md` lists them, which `lobe help scene-format` prints.
///
/// ```
/// use lobe::scene_file::parse_scene;
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
/// # Ok::<(), lobe::scene_file::SceneFileError>(())
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
    let source = Source::new(path, text, overrides);
    let document = source.parse()?;
    let description = source.place(assemble::describe(&document))?;
    let (scene, view, settings, meshes) = source.place(assemble::build(description, &document))?;
    let seconds = start.seconds() - scene.build_seconds();
    Ok(LoadedScene { scene, view, settings, report: LoadReport { seconds, meshes } })
}
