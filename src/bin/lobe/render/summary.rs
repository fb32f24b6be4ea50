//! What `lobe render` prints at its end.

use std::path::Path;

use lobe::render::Rendered;
use lobe::scene_file::LoadedScene;

use crate::summary::Summary;

/// How many of the things that were left out of MTL files are listed.
const MOST_NOTES: usize = 20;

/// The summary of a render of the scene in this file.
pub fn of(loaded: &LoadedScene, rendered: &Rendered, file: &Path) -> Summary {
    let LoadedScene { scene, view, report, .. } = loaded;
    let mut summary = Summary::default();
    summary.add("scene", file.display());
    summary.add_film(view.film());
    summary.add("samples", format!("{} per pixel", rendered.samples_per_pixel));
    summary.add_meshes(scene);
    let instances = scene.instances().count() + scene.copies().count();
    if instances > 0 {
        summary.add("instances", instances);
    }
    summary.add("threads", rendered.threads);
    summary.add("isa", scene.accel().instruction_set());
    summary.add("load", format!("{:.3} s", report.seconds));
    summary.add("build", format!("{:.3} s", scene.build_seconds()));
    summary.add("render", format!("{:.3} s", rendered.seconds));
    let rays = rendered.counters.rays();
    summary.add("rays", rays);
    summary.add("speed", format!("{:.2} Mrays/s", rays as f64 / rendered.seconds / 1e6));
    summary.add_error(&rendered.picture);
    summary.add_fireflies(rendered.fireflies);
    add_faults(&mut summary, rendered);
    summary.add_warnings(scene, report);
    summary.add_notes(report, MOST_NOTES);
    summary
}

fn add_faults(summary: &mut Summary, rendered: &Rendered) {
    summary.add("non-finite", format!("{} samples", rendered.non_finite));
    if rendered.counters.rejected > 0 {
        summary.add("rejected", format!("{} lobe values", rendered.counters.rejected));
    }
    if rendered.counters.refused_camera_rays > 0 {
        summary.add("refused", format!("{} camera rays", rendered.counters.refused_camera_rays));
    }
    if !rendered.complete && rendered.empty_pixels > 0 {
        summary.add(
            "empty",
            format!("{} pixels, black: there was no time for them", rendered.empty_pixels),
        );
    }
}
