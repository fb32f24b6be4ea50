//! `lobe info`: the contents of a scene file.

use std::error::Error;

use clap::Args;
use lobe::TriangleMesh;
use lobe::params::Choice;
use lobe::render::{RenderSettings, SamplerSettings};
use lobe::scene::View;
use lobe::scene_file::LoadedScene;

use crate::scene::{IsaArgument, SceneArguments};
use crate::summary::Summary;

const EXAMPLES: &str = "\
Examples:
  lobe info chapter8.toml
  lobe info chapter8.toml --set shape.dragon.scale=2    bounds at twice the size
  lobe info chapter8.toml | awk '$1 == \"triangles\" { print $2 }'";

/// Shows the contents of a scene file: settings, triangles, bounds, tree, memory
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,

    #[command(flatten)]
    isa: IsaArgument,
}

pub fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let LoadedScene { scene, view, settings, report, .. } =
        arguments.scene.load_for(&arguments.isa)?;
    let mut summary = Summary::default();
    summary.add("scene", arguments.scene.path.display());
    add_view(&mut summary, &view);
    add_settings(&mut summary, &settings);
    summary.add("lights", scene.lights().len());
    for ((name, mesh), odd) in scene.shapes().zip(&report.meshes) {
        let mut line = format!("{name}: {} triangles", mesh.indices.len());
        if odd.degenerate_triangles > 0 {
            line += &format!(", {} of them without area", odd.degenerate_triangles);
        }
        if odd.unused_vertices > 0 {
            line += &format!(", {} unused vertices", odd.unused_vertices);
        }
        summary.add("shape", line);
    }
    summary.add_warnings(&scene, &report);
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
    summary.add("isa", accel.instruction_set());
    summary.add("load", format!("{:.3} s", report.seconds));
    summary.add("build", format!("{:.3} s", scene.build_seconds()));
    summary.print()?;
    Ok(())
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
