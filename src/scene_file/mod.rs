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
mod model;
mod overrides;
mod prepare;
mod report;
mod sections;
mod text;
mod toml_tree;
mod used;
mod write;

use std::path::{Path, PathBuf};
use std::sync::Arc;

pub use error::{Place, SceneFileError, TextProblem};
pub use report::{FaceMaterial, LoadReport, NamedKind, TextureImage};
pub use sections::SECTIONS;

use crate::accel::InstructionSet;
use crate::clock::Stopwatch;
use crate::material::Material;
use crate::params::{Document, Fault};
use crate::render::RenderSettings;
use crate::scene::{Scene, View};
use crate::shape::ObjMesh;
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
    /// Load time, warnings, and what was found in MTL files.
    pub report: LoadReport,
    materials: Vec<(String, Arc<dyn Material>)>,
    textures: Textures,
    faces: Found,
    document: Document,
}

impl LoadedScene {
    /// The materials of the file by name, in its order, whether or not a shape has them; then those of MTL files that faces name.
    pub fn materials(&self) -> impl Iterator<Item = (&str, &dyn Material)> {
        let all = self.materials.iter().chain(&self.faces.materials);
        all.map(|(name, material)| (name.as_str(), &**material))
    }

    /// The files that the scene refers to, with those that they refer to: MTL files and images. The scene file is not among them.
    pub fn files(&self) -> Vec<PathBuf> {
        let images = self.textures.images().into_iter().map(|(file, ..)| file);
        self.document.files().into_iter().chain(self.faces.files.clone()).chain(images).collect()
    }

    /// The text of a scene file with all values, those of overrides among them. Its paths are those of the file, which are relative to the
    /// folder of the file, and those of overrides and of the scene of an OBJ file, which are relative to the current directory. Comments at
    /// its end name the materials of MTL files that faces have, as tables that would replace them.
    pub fn to_toml(&self) -> String {
        write::toml(&self.document.root) + &write::replaceable(&self.faces.unclaimed)
    }

    /// What is rendered, as lines `key = value`: the version of this crate, all values of the file and the overrides, and
    /// checksums of each mesh, each image and the materials of faces. Renders of equal identity give the same picture for the same samples.
    pub fn identity(&self) -> Vec<String> {
        identity::lines(&self.document, &self.scene, &self.textures, &self.faces.identity)
    }
}

/// Reads the scene file at `path` with `overrides`. See [`parse_scene`].
///
/// If the name ends in .obj it is a model, for which a scene is made: with the materials of its MTL files, a grey sky and a key light, seen from the
/// front, right and above by a camera that stands where all of it is in the picture, in a right-handed world with y up. The shape
/// is `model`, so that `shape.model.rotate` and others can be overridden. [`LoadedScene::to_toml`] has the scene as text.
///
/// # Errors
/// If the file cannot be read, is not an ordinary one, has more than 128 MiB, or has a name that ends neither in .toml nor in .obj, and
/// those of [`parse_scene`] or [`read_obj`](crate::shape::read_obj). Messages name the file by `path`.
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
    let mut loaded = if model::is_model(path) {
        let source = Source::of_model(path, model::tree(path), overrides);
        let mut document = source.parse()?;
        let mesh = prepare::mesh(&source, path, &mut document)?;
        finish(instruction_set, &source, document, mesh)?
    } else {
        parse_for(instruction_set, path, &text::of_scene(path)?, overrides)?
    };
    loaded.report.seconds = start.seconds() - loaded.scene.build_seconds();
    Ok(loaded)
}

/// Reads only sampler and integrator of the scene file at `path` with `overrides`. Meshes are not loaded.
///
/// # Errors
/// Those of [`read_scene`], except for unknown materials and invalid meshes; of a model only those about sampler and integrator.
pub fn read_settings(path: &Path, overrides: &[&str]) -> Result<RenderSettings, SceneFileError> {
    if model::is_model(path) {
        let source = Source::of_model(path, model::tree(path), overrides);
        return source.place(assemble::settings(&source.parse()?));
    }
    let text = text::of_scene(path)?;
    let source = Source::new(path, &text, overrides);
    Ok(source.place(assemble::describe(&source.parse()?))?.settings)
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
    let text = text::of_file(path)?;
    let source = Source::new(path, &text, &[]);
    source.place(read(&source.parse()?))
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
    let mut loaded = finish(instruction_set, &source, document, None)?;
    loaded.report.seconds = start.seconds() - loaded.scene.build_seconds();
    Ok(loaded)
}

/// Builds the scene of a document. `mesh` is that of a model.
fn finish(
    instruction_set: InstructionSet,
    source: &Source,
    document: Document,
    mesh: Option<ObjMesh>,
) -> Result<LoadedScene, SceneFileError> {
    let mut description = source.place(assemble::describe(&document))?;
    if let Some(mesh) = mesh {
        description = description.with_mesh(model::NAME, mesh);
    }
    let (materials, textures) = (description.materials.clone(), description.textures.clone());
    let Built { scene, view, settings, reports: meshes, mut faces } =
        source.place(assemble::build(description, &document, instruction_set))?;
    let report = LoadReport {
        seconds: 0.0,
        materials: used::materials(&document.root, &faces.counts),
        textures: used::textures(&document.root),
        meshes,
        notes: std::mem::take(&mut faces.notes),
        face_materials: std::mem::take(&mut faces.counts),
        images: textures.images().into_iter().map(TextureImage::of).collect(),
    };
    Ok(LoadedScene { scene, view, settings, report, materials, textures, faces, document })
}
