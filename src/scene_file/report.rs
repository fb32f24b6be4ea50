//! [`LoadReport`]: what there is to say about loading a scene.

use std::path::PathBuf;
use std::sync::Arc;

use glam::UVec2;

use crate::shape::ObjReport;
use crate::texture::{Curve, Texels};

/// Load time of a scene, and what was found in its meshes, materials and images.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct LoadReport {
    /// Wall-clock time in seconds, without building the acceleration structure.
    pub seconds: f64,
    /// Warnings about each mesh, in the order of [`Scene::shapes`](crate::Scene::shapes).
    pub meshes: Vec<ObjReport>,
    /// What was left out of MTL files, with file and line, and faces without a material.
    pub notes: Vec<String>,
    /// The materials that faces name, for each shape in the order of its file.
    pub face_materials: Vec<FaceMaterial>,
    /// The materials of the scene file, in its order.
    pub materials: Vec<NamedKind>,
    /// The textures of the scene file, in its order.
    pub textures: Vec<NamedKind>,
    /// The images of textures, by file; one file twice if its codes mean different things to two of them.
    pub images: Vec<TextureImage>,
}

/// A material or a texture of a scene file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct NamedKind {
    /// Its name.
    pub name: String,
    /// Its `type`.
    pub kind: String,
    /// Whether anything in the scene refers to it.
    pub is_used: bool,
}

/// A material that triangles of an OBJ file name.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct FaceMaterial {
    /// Its name among the scene's materials.
    pub name: String,
    /// Number of the triangles.
    pub triangle_count: usize,
    /// Whether they emit light.
    pub is_emitting: bool,
}

/// An image that textures share.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct TextureImage {
    /// The file.
    pub file: PathBuf,
    /// What its codes mean.
    pub curve: Curve,
    /// Columns and rows.
    pub size: UVec2,
    /// Bytes in memory.
    pub bytes: usize,
}

impl TextureImage {
    pub(super) fn of((file, curve, texels): (PathBuf, Curve, Arc<Texels>)) -> Self {
        Self { file, curve, size: texels.size(), bytes: texels.bytes() }
    }
}
