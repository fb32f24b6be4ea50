//! Scene files: TOML with overrides, and errors with line and column.
//!
//! The text is parsed to a [`params`](crate::params) tree, whose tables are read by the registries that
//! [`SECTIONS`] lists. [docs/scene-format.md] documents all tables and keys; `lobe help scene-format` prints the same page.
//!
//! [docs/scene-format.md]: https://docs.rs/crate/lobe/latest/source/docs/scene-format.md

mod assemble;
mod document;
mod error;
mod faces;
mod identity;
mod overrides;
mod sections;
mod toml_tree;

use std::path::{Path, PathBuf};
use std::sync::Arc;

pub use error::{Place, SceneFileError, TextProblem};
pub use sections::SECTIONS;

use crate::accel::InstructionSet;
use crate::clock::Stopwatch;
use crate::file;
use crate::material::Material;
use crate::params::{Document, Fault, Mark};
use crate::render::RenderSettings;
use crate::scene::{Scene, View};
use crate::shape::ObjReport;
use crate::texture::Textures;
use assemble::Built;
use document::Source;
use faces::Found;

/// A scene, view and settings from a file.
pub struct LoadedScene {
    /// The scene.
    pub scene: Scene,
    /// Camera and film.
    pub view: View,
    /// Sampler and integrator.
    pub settings: RenderSettings,
    /// Load time and warnings about meshes.
    pub report: LoadReport,
    materials: Vec<(String, Arc<dyn Material>)>,
    textures: Textures,
    faces: Found,
    document: Document,
}

impl LoadedScene {
    /// The materials of the file by name, in its order, whether or not a shape has them.
    pub fn materials(&self) -> impl ExactSizeIterator<Item = (&str, &dyn Material)> {
        self.materials.iter().map(|(name, material)| (name.as_str(), &**material))
    }

    /// The files that the scene refers to, with those that they refer to: MTL files and images. The scene file is not among them.
    pub fn files(&self) -> Vec<PathBuf> {
        let images = self.textures.images().into_iter().map(|(file, ..)| file);
        self.document.files().into_iter().chain(self.faces.files.clone()).chain(images).collect()
    }

    /// What is rendered, as lines `key = value`: the version of this crate, all values of the file and the overrides, and
    /// checksums of each mesh, each image and the materials of faces. Renders of equal identity give the same picture for the same samples.
    pub fn identity(&self) -> Vec<String> {
        identity::lines(&self.document, &self.scene, &self.textures, &self.faces.identity)
    }
}

/// Load time of a scene, and warnings about its meshes.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct LoadReport {
    /// Wall-clock time in seconds, without building the acceleration structure.
    pub seconds: f64,
    /// Warnings about each mesh, in the order of [`Scene::shapes`].
    pub meshes: Vec<ObjReport>,
    /// What was left out of MTL files, with file and line, and faces without a material.
    pub notes: Vec<String>,
}

/// Reads the scene file at `path` with `overrides`. See [`parse_scene`].
///
/// # Errors
/// If the file cannot be read, is not an ordinary one, or has more than 128 MiB, and those of [`parse_scene`]. Messages
/// name the file by `path`.
pub fn read_scene(path: &Path, overrides: &[&str]) -> Result<LoadedScene, SceneFileError> {
    read_scene_for(InstructionSet::fastest(), path, overrides)
}

/// [`read_scene`] for an instruction set other than the fastest: see
/// [`SceneBuilder::instruction_set`](crate::scene::SceneBuilder::instruction_set).
///
/// # Errors
/// Those of [`read_scene`].
pub fn read_scene_for(
    instruction_set: InstructionSet,
    path: &Path,
    overrides: &[&str],
) -> Result<LoadedScene, SceneFileError> {
    let start = Stopwatch::start();
    let text = read_text(path)?;
    let mut loaded = parse_for(instruction_set, path, &text, overrides)?;
    loaded.report.seconds = start.seconds() - loaded.scene.build_seconds();
    Ok(loaded)
}

/// Reads only sampler and integrator of the scene file at `path` with `overrides`. Meshes are not loaded.
///
/// # Errors
/// Those of [`read_scene`], except for unknown materials and invalid meshes.
pub fn read_settings(path: &Path, overrides: &[&str]) -> Result<RenderSettings, SceneFileError> {
    Ok(read_with(path, overrides, assemble::describe)?.settings)
}

/// Reads a TOML file that is not a scene, such as a list of methods: passes its tree to `read`, and adds file, line and
/// column to the faults that `read` returns.
///
/// # Errors
/// If the file cannot be read, is not an ordinary one, has more than 128 MiB, or is not TOML, and those of `read`.
pub fn read_document<T>(
    path: &Path,
    read: impl FnOnce(&Document) -> Result<T, Fault>,
) -> Result<T, SceneFileError> {
    read_with(path, &[], read)
}

fn read_with<T>(
    path: &Path,
    overrides: &[&str],
    read: impl FnOnce(&Document) -> Result<T, Fault>,
) -> Result<T, SceneFileError> {
    let text = read_text(path)?;
    let source = Source::new(path, &text, overrides);
    source.place(read(&source.parse()?))
}

/// Maximum size of a file, in MiB: for scenes of more than three million materials.
const MOST: u64 = 128;

fn read_text(path: &Path) -> Result<String, SceneFileError> {
    let unreadable = |source| SceneFileError::Unreadable { path: path.to_owned(), source };
    String::from_utf8(file::read(path, MOST).map_err(unreadable)?).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        let place = document::file_place(path, error.as_bytes(), offset);
        let problem = TextProblem::Toml("the text is not UTF-8".into());
        SceneFileError::Wrong { place, problem: Fault::new(Mark::default(), problem).problem }
    })
}

/// Builds a scene from the text of a scene file and the meshes it refers to.
///
/// `path` is the file's name in messages, and need not exist. Paths of OBJ files are relative to its folder.
///
/// Each of `overrides` is `KEY=VALUE` in TOML, such as `camera.fov=40`, and replaces or adds that value; later
/// overrides win. Paths in overrides are relative to the current directory. Overrides cannot add textures,
/// materials, lights or shapes.
///
/// # The format
/// All tables and keys are optional unless documented as required; unknown ones are errors.
/// `docs/scene-format.md` lists them, and `lobe help scene-format` prints the same page.
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
/// The first error, with its line and column or its override.
pub fn parse_scene(
    path: &Path,
    text: &str,
    overrides: &[&str],
) -> Result<LoadedScene, SceneFileError> {
    parse_for(InstructionSet::fastest(), path, text, overrides)
}

fn parse_for(
    instruction_set: InstructionSet,
    path: &Path,
    text: &str,
    overrides: &[&str],
) -> Result<LoadedScene, SceneFileError> {
    let start = Stopwatch::start();
    let source = Source::new(path, text, overrides);
    let document = source.parse()?;
    let description = source.place(assemble::describe(&document))?;
    let (materials, textures) = (description.materials.clone(), description.textures.clone());
    let built = source.place(assemble::build(description, &document, instruction_set))?;
    let Built { scene, view, settings, reports, faces } = built;
    let seconds = start.seconds() - scene.build_seconds();
    let report = LoadReport { seconds, meshes: reports, notes: faces.notes.clone() };
    Ok(LoadedScene { scene, view, settings, report, materials, textures, faces, document })
}
