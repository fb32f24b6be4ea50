//! [`mesh`]: completes the scene of a model.

use std::path::Path;

use super::document::Source;
use super::error::SceneFileError;
use super::{assemble, model};
use crate::params::Document;
use crate::shape::{ObjMesh, read_obj};

/// Loads the mesh of a model, and adds what depends on it to its scene: the camera's place and the material of a model without any.
/// `None` if an override took the shape away.
pub fn mesh(
    source: &Source,
    path: &Path,
    document: &mut Document,
) -> Result<Option<ObjMesh>, SceneFileError> {
    let Some(stage) = source.place(assemble::stage(document, model::NAME))? else {
        return Ok(None);
    };
    // By its path unless an override names another: the tree holds text alone.
    let is_own = document.root.follow(&["shape", model::NAME, "obj"]).mark.source == 0;
    let loaded = if is_own { read_obj(path)? } else { source.place((stage.load)())? };
    let corners = loaded.mesh.indices.iter().flatten();
    let corner = |&i: &u32| stage.transform.transform_point3(loaded.mesh.positions[i as usize]);
    model::place_camera(&mut document.root, corners.map(corner), stage.resolution);
    if stage.is_bare {
        match loaded.materials.of_triangles.is_empty() {
            true => model::make_grey(&mut document.root),
            false => source.place(model::drop_grey(&mut document.root))?,
        }
    }
    Ok(Some(loaded))
}
