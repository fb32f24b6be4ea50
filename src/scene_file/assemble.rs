//! Conversion of a document to a scene.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::{Affine3A, Quat, UVec2};

use super::faces::{FaceMaterials, Found};
use super::sections::{self, SECTIONS};
use crate::accel::InstructionSet;
use crate::camera::Camera;
use crate::image::Window;
use crate::light::Light;
use crate::material::{self, DetailedMaterial, Material, Materials};
use crate::params::{Document, Fault, Kind, Mark, Problem, Table};
use crate::render::{RenderSettings, SamplerSettings};
use crate::sampling::SamplerKind;
use crate::scene::{Emission, FilmSettings, Scene, SceneBuilder, SceneError, View};
use crate::shape::{Load, ObjMesh, ObjReport};
use crate::spectrum::Spectrum;
use crate::texture::{self, TextureHandle, Textures};

/// A scene before its meshes are loaded. Lists are in the order of the file.
pub struct Description {
    view: View,
    pub settings: RenderSettings,
    pub materials: Vec<(String, Arc<dyn Material>)>,
    pub textures: Textures,
    lights: Vec<Arc<dyn Light>>,
    shapes: Vec<(String, Shape)>,
    instances: Vec<NewInstance>,
}

/// A shape once more.
struct NewInstance {
    name: String,
    /// The shape's name, and the position of that name.
    shape: (String, Mark),
    transform: Affine3A,
}

/// What a shape without a material is told.
const MATERIAL_OR: &str =
    "the name of a material, or `emission`, or an OBJ file whose faces name materials";

struct Shape {
    load: Load,
    /// Name of the material and position of that name.
    material: Option<(String, Mark)>,
    /// What is wrong if there is no material, and faces name none either; `None` for an emitter, which may reflect nothing.
    missing: Option<Fault>,
    emission: Option<Emission<TextureHandle<Spectrum>>>,
    /// Whether faces with a lamp's material emit on both sides.
    two_sided: bool,
    /// From mesh to world space.
    transform: Affine3A,
}

/// Reads all tables. Mesh files are not opened.
pub fn describe(document: &Document) -> Result<Description, Fault> {
    let root = document.table("the scene", &SECTIONS.map(|section| section.key()))?;
    let film = film(root.table(sections::FILM.key)?)?;
    let camera = root.table(sections::CAMERA.key)?;
    let camera =
        sections::CAMERA.read(camera, |kind, table| (kind.read)(table, film.resolution))?;
    let view = view(camera, film, document)?;
    let settings = settings(document)?;
    let mut textures = Textures::default();
    for (name, table) in root.tables(sections::TEXTURE.key)? {
        let read = |kind: &Kind<texture::Read>, table: &Table| {
            Ok(((kind.read)(table, &textures)?, table.cost()))
        };
        let (texture, cost) = sections::TEXTURE.read(table, read)?;
        textures.add_costing(name, texture, cost);
    }
    let (mut materials, mut known) = (Vec::new(), Materials::default());
    for (name, table) in root.tables(sections::MATERIAL.key)? {
        let read = |kind: &Kind<material::Read>, table: &Table| {
            let material = (kind.read)(table, &textures, &known)?;
            Ok((DetailedMaterial::read(table, &textures, material)?, table.cost()))
        };
        let (material, cost) = sections::MATERIAL.read(table, read)?;
        known.add_costing(name, material.clone(), cost);
        materials.push((name.to_owned(), material));
    }
    let light =
        |(_, table): (&str, Table)| sections::LIGHT.read(table, |kind, table| (kind.read)(table));
    let shape = |(name, table): (&str, Table)| Ok((name.to_owned(), shape(table, &textures)?));
    let lights = all(root.tables(sections::LIGHT.key)?, light)?;
    let shapes = all(root.tables(sections::SHAPE.key)?, shape)?;
    let instances = all(root.tables(sections::INSTANCE.key)?, instance)?;
    Ok(Description { view, settings, materials, textures, lights, shapes, instances })
}

fn all<T, U>(tables: Vec<T>, read: impl FnMut(T) -> Result<U, Fault>) -> Result<Vec<U>, Fault> {
    tables.into_iter().map(read).collect()
}

/// Only the crop can be invalid here: the keys have checked everything else.
fn view(camera: Arc<dyn Camera>, film: FilmSettings, document: &Document) -> Result<View, Fault> {
    View::new(camera, film).map_err(|error| {
        let keys = [sections::FILM.key, sections::CROP.name()];
        Fault::new(document.root.follow(&keys).mark, error)
    })
}

fn film(table: Table) -> Result<FilmSettings, Fault> {
    let window =
        |[x0, y0, x1, y1]: [u32; 4]| Window { min: UVec2::new(x0, y0), max: UVec2::new(x1, y1) };
    sections::FILM.read(table, |kind, table| {
        Ok(FilmSettings {
            resolution: table.get(&sections::RESOLUTION)?,
            crop: table.get(&sections::CROP)?.map(window),
            display: table.get(&sections::DISPLAY)?,
            filter: (kind.read)(table)?,
        })
    })
}

fn sampler(table: Table) -> Result<SamplerSettings, Fault> {
    sections::SAMPLER.read(table, |kind, table| {
        Ok(SamplerSettings {
            kind: SamplerKind(kind),
            spp: table.get(&sections::SPP)?,
            seed: table.get(&sections::SEED)?,
            replicates: table.get(&sections::REPLICATES)?,
        })
    })
}

fn shape(table: Table, textures: &Textures) -> Result<Shape, Fault> {
    sections::SHAPE.read(table, |kind, table| {
        let two_sided = table.get(&sections::TWO_SIDED)?;
        let emission = textures.find(table, &sections::EMISSION)?;
        let emission = emission
            .map(|radiance| Emission { radiance, two_sided: two_sided.unwrap_or_default() });
        let transform = transform(table)?;
        let load = (kind.read)(table)?;
        let material = table.get(&sections::SHAPE_MATERIAL)?;
        let is_missing = material.is_none() && emission.is_none();
        let missing = is_missing.then(|| table.lacks(&sections::SHAPE_MATERIAL, MATERIAL_OR));
        let mark = table.mark(&sections::SHAPE_MATERIAL);
        Ok(Shape {
            load,
            material: material.map(|material| (material, mark)),
            missing,
            emission,
            two_sided: two_sided.unwrap_or(true),
            transform,
        })
    })
}

fn instance((name, table): (&str, Table)) -> Result<NewInstance, Fault> {
    sections::INSTANCE.read(table, |kind, table| {
        let (name, transform) = (name.to_owned(), transform(table)?);
        Ok(NewInstance { name, shape: (kind.read)(table)?, transform })
    })
}

/// Scale, then rotate, then translate.
fn transform(table: &Table) -> Result<Affine3A, Fault> {
    let scale = table.get(&sections::SCALE)?.0;
    let rotation = table.get(&sections::ROTATE)?.map_or(Quat::IDENTITY, Quat::from);
    let translation = table.get(&sections::TRANSLATE)?;
    Ok(Affine3A::from_scale_rotation_translation(scale, rotation, translation))
}

/// What the camera of a model depends on.
pub struct Stage {
    /// Of the film.
    pub resolution: UVec2,
    pub load: Load,
    /// From mesh to world space.
    pub transform: Affine3A,
    /// Whether the shape has neither material nor emission.
    pub is_bare: bool,
}

/// Reads film and shape alone; `None` without a shape of this name.
pub fn stage(document: &Document, name: &str) -> Result<Option<Stage>, Fault> {
    let root = document.table("the scene", &SECTIONS.map(|section| section.key()))?;
    let resolution = film(root.table(sections::FILM.key)?)?.resolution;
    let mut shapes = root.tables(sections::SHAPE.key)?.into_iter();
    let Some((_, table)) = shapes.find(|(known, _)| *known == name) else { return Ok(None) };
    // A model's scene has no textures, and overrides cannot add any.
    let Shape { load, transform, missing, .. } = shape(table, &Textures::default())?;
    Ok(Some(Stage { resolution, load, transform, is_bare: missing.is_some() }))
}

/// Reads sampler and integrator alone.
pub fn settings(document: &Document) -> Result<RenderSettings, Fault> {
    let root = document.table("the scene", &SECTIONS.map(|section| section.key()))?;
    let integrator = root.table(sections::INTEGRATOR.key)?;
    Ok(RenderSettings {
        sampler: sampler(root.table(sections::SAMPLER.key)?)?,
        integrator: sections::INTEGRATOR.read(integrator, |kind, table| (kind.read)(table))?,
    })
}

impl Description {
    /// The same with the mesh of a shape, which was loaded before.
    pub fn with_mesh(mut self, name: &str, mesh: ObjMesh) -> Self {
        if let Some((_, shape)) = self.shapes.iter_mut().find(|(known, _)| known == name) {
            shape.load = Box::new(move || Ok(mesh));
        }
        self
    }
}

/// A scene whose meshes are loaded.
pub struct Built {
    pub scene: Scene,
    pub view: View,
    pub settings: RenderSettings,
    /// About each mesh, in the order of [`Scene::shapes`].
    pub reports: Vec<ObjReport>,
    pub faces: Found,
}

/// Looks up materials, loads the meshes and builds the scene.
pub fn build(
    description: Description,
    document: &Document,
    instruction_set: InstructionSet,
) -> Result<Built, Fault> {
    let Description { view, settings, materials, textures, lights, shapes, instances } =
        description;
    let fault = |error: SceneError| {
        let keys = match &error {
            SceneError::Mesh(shape, _) => vec![sections::SHAPE.key, shape],
            SceneError::Instance { instance, .. } => vec![sections::INSTANCE.key, instance],
            _ => vec![sections::SHAPE.key],
        };
        Fault::new(document.root.follow(&keys).mark, error)
    };
    let known: BTreeSet<&str> = materials.iter().map(|(name, _)| name.as_str()).collect();
    for (material, mark) in shapes.iter().filter_map(|(_, shape)| shape.material.as_ref()) {
        if !known.contains(material.as_str()) {
            let known = materials.iter().map(|(name, _)| name.as_str());
            let problem = Problem::unknown_name(sections::MATERIAL.key, material, known);
            return Err(Fault { mark: *mark, problem });
        }
    }
    for NewInstance { shape: (shape, mark), .. } in &instances {
        if !shapes.iter().any(|(name, _)| name == shape) {
            let known = shapes.iter().map(|(name, _)| name.as_str());
            let problem = Problem::unknown_name(sections::SHAPE.key, shape, known);
            return Err(Fault { mark: *mark, problem });
        }
    }
    let builder = lights
        .into_iter()
        .fold(Scene::builder().instruction_set(instruction_set), SceneBuilder::light);
    let by_name: BTreeMap<String, Arc<dyn Material>> = materials.iter().cloned().collect();
    let mut builder = materials
        .into_iter()
        .fold(builder, |builder, (name, material)| builder.material(name, material));
    let mut reports = Vec::with_capacity(shapes.len());
    // Of shapes that became several.
    let mut parts = BTreeMap::new();
    let names = shapes.iter().map(|(name, _)| name.clone()).collect();
    let mut faces = FaceMaterials::new(&by_name, &textures, names);
    for (name, Shape { load, material, missing, emission, two_sided, transform }) in shapes {
        let ObjMesh { mut mesh, report, materials } = load()?;
        reports.push(report);
        mesh.transform(&transform);
        let names_some = !materials.of_triangles.is_empty() && emission.is_none();
        builder = match (material, missing) {
            (None, _) if names_some => {
                let (builder, names) = faces.add(builder, &name, &mesh, &materials, two_sided);
                // What is odd about the file is said once.
                reports.resize(reports.len() + names.len() - 1, ObjReport::default());
                parts.insert(name, names);
                builder
            }
            (None, Some(missing)) => return Err(missing),
            (material, _) => {
                builder.add_shape(name, mesh, material.map(|(name, _)| name), emission)
            }
        };
    }
    for NewInstance { name, shape: (shape, _), transform } in instances {
        let parts = parts.get(&shape).cloned().unwrap_or_else(|| vec![shape]);
        builder = parts
            .into_iter()
            .fold(builder, |builder, part| builder.instance(name.clone(), part, transform));
    }
    let (scene, faces) = (builder.build().map_err(fault)?, faces.found);
    // Copies come last.
    reports.resize(scene.shapes().count(), ObjReport::default());
    Ok(Built { scene, view, settings, reports, faces })
}
