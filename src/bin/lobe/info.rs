//! `lobe info`: the contents of a scene file or a model.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

use clap::Args;
use lobe::TriangleMesh;
use lobe::glam::UVec2;
use lobe::params::{Choice, Shown};
use lobe::render::{RenderSettings, SamplerSettings};
use lobe::scene::{Scene, View};
use lobe::scene_file::{FaceMaterial, LoadReport, LoadedScene, NamedKind, TextureImage};

use crate::scene::{IsaArgument, SceneArguments};
use crate::summary::{Summary, print};

const EXAMPLES: &str = "\
Examples:
  lobe info chapter8.toml
  lobe info chapter8.toml --set shape.dragon.scale=2    bounds at twice the size
  lobe info model.obj                                   materials, textures, and what of them is not understood
  lobe info model.obj --scene > model.toml              the scene that lobe render makes for it, to change it
  lobe info chapter8.toml | awk '$1 == \"triangles\" { print $2 }'";

/// Shows the contents of a scene file or a model: settings, triangles, materials, textures, bounds, tree, memory
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,

    #[command(flatten)]
    isa: IsaArgument,

    /// Prints the scene that is made for a model, with all overrides, as a scene file for this directory
    #[arg(long = "scene")]
    as_scene: bool,
}

pub fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let loaded = arguments.scene.load_for(&arguments.isa)?;
    if arguments.as_scene {
        return scene_text(&loaded, &arguments.scene.path);
    }
    let LoadedScene { scene, view, settings, report, .. } = loaded;
    let mut summary = Summary::default();
    summary.add("scene", arguments.scene.path.display());
    add_view(&mut summary, &view);
    add_settings(&mut summary, &settings);
    summary.add("lights", scene.lights().len());
    // Copies come last, and are counted.
    let own = scene.shapes().count() - scene.copies().count();
    for ((name, mesh), odd) in scene.shapes().zip(&report.meshes).take(own) {
        let mut line = format!("{name}: {} triangles", mesh.indices.len());
        if odd.degenerate_triangles > 0 {
            line += &format!(", {} of them without area", odd.degenerate_triangles);
        }
        if odd.unused_vertices > 0 {
            line += &format!(", {} unused vertices", odd.unused_vertices);
        }
        summary.add("shape", line);
    }
    add_instances(&mut summary, &scene);
    add_materials(&mut summary, &report);
    summary.add_warnings(&scene, &report);
    summary.add_notes(&report, usize::MAX);
    summary.add_meshes(&scene);
    let accel = scene.accel();
    if !accel.bounds().is_empty() {
        summary.add("bounds", format!("{} to {}", accel.bounds().min, accel.bounds().max));
    }
    summary.add("nodes", accel.node_count());
    summary.add("depth", format!("{} nodes", accel.depth()));
    let meshes: usize = scene.shapes().map(|(_, mesh)| memory(mesh)).sum();
    summary.add("tree-memory", format!("{:.2} MiB", accel.memory() as f64 / MIB));
    summary.add("mesh-memory", format!("{:.2} MiB", meshes as f64 / MIB));
    let images: usize = report.images.iter().map(|image| image.bytes).sum();
    if images > 0 {
        summary.add("texture-memory", format!("{:.2} MiB", images as f64 / MIB));
    }
    summary.add("isa", accel.instruction_set());
    summary.add("load", format!("{:.3} s", report.seconds));
    summary.add("build", format!("{:.3} s", scene.build_seconds()));
    summary.print()?;
    Ok(())
}

/// Prints the scene of a model.
fn scene_text(loaded: &LoadedScene, path: &Path) -> Result<(), Box<dyn Error>> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
        let shown = Shown::path(path);
        return Err(format!("`{shown}` is a scene file already: --scene is for models").into());
    }
    Ok(print(&loaded.to_toml())?)
}

/// A line for each shape that has instances, or copies in place of these.
fn add_instances(summary: &mut Summary, scene: &Scene) {
    for (shape, count) in counts(scene.instances()) {
        summary.add("instances", format!("{shape}: {count}"));
    }
    for (shape, count) in counts(scene.copies()) {
        let copies = if count == 1 { "copy" } else { "copies" };
        summary.add("instances", format!("{shape}: {count} {copies}"));
    }
}

fn counts<'a>(all: impl Iterator<Item = (&'a str, &'a str)>) -> BTreeMap<&'a str, usize> {
    let mut counts = BTreeMap::new();
    all.for_each(|(_, shape)| *counts.entry(shape).or_insert(0) += 1);
    counts
}

/// A line for each material, with the triangles of faces that name it, for each texture, and for each image.
fn add_materials(summary: &mut Summary, report: &LoadReport) {
    let named = |NamedKind { name, kind, is_used, .. }: &NamedKind| {
        format!("{name}: {kind}{}", if *is_used { "" } else { ", not used" })
    };
    for material in &report.materials {
        let faces = report.face_materials.iter().filter(|face| face.name == material.name);
        let faces: String = faces.map(|face| format!(", {}", triangles(face))).collect();
        summary.add("material", named(material) + &faces);
    }
    let is_own = |face: &&FaceMaterial| report.materials.iter().any(|own| own.name == face.name);
    for face in report.face_materials.iter().filter(|face| !is_own(face)) {
        summary.add("material", format!("{}: {}", face.name, triangles(face)));
    }
    for texture in &report.textures {
        summary.add("texture", named(texture));
    }
    let here = std::env::current_dir().unwrap_or_default();
    for TextureImage { file, curve, size, bytes, .. } in &report.images {
        let file = file.strip_prefix(&here).unwrap_or(file);
        let (file, curve, mib) = (file.display(), curve.name(), *bytes as f64 / MIB);
        let UVec2 { x, y } = size;
        summary.add("texture", format!("{file}: {x}x{y} pixels, {curve}, {mib:.2} MiB"));
    }
}

fn triangles(FaceMaterial { triangle_count, is_emitting, .. }: &FaceMaterial) -> String {
    format!("{triangle_count} triangles{}", if *is_emitting { ", emitting" } else { "" })
}

const MIB: f64 = (1 << 20) as f64;

/// Memory of a mesh, in bytes.
fn memory(mesh: &TriangleMesh) -> usize {
    let TriangleMesh { positions, normals, uvs, indices } = mesh;
    size_of_val(&positions[..])
        + size_of_val(&normals[..])
        + size_of_val(&uvs[..])
        + size_of_val(&indices[..])
}

/// Lines for camera and film.
fn add_view(summary: &mut Summary, view: &View) {
    summary.add("camera", view.camera().describe());
    summary.add_film(view.film());
    summary.add("display", view.film().display.name());
    summary.add("filter", view.film().filter.describe());
}

/// A line each for sampler and integrator.
fn add_settings(summary: &mut Summary, settings: &RenderSettings) {
    let SamplerSettings { kind, spp, seed, .. } = settings.sampler;
    let sets = match settings.sampler.sets() {
        1 => String::new(),
        sets => format!(" in {sets} sets"),
    };
    summary.add("sampler", format!("{}, {spp} samples per pixel{sets}, seed {seed}", kind.name()));
    summary.add("integrator", settings.integrator.describe());
}
