//! [`NewShape`]: a shape before its scene is built.

use std::sync::Arc;

use super::settings::Emission;
use crate::light::Light;
use crate::shape::TriangleMesh;
use crate::spectrum::Spectrum;
use crate::texture::TextureHandle;

/// Emission of a shape, before `build`.
#[derive(Clone)]
pub(super) enum NewEmission {
    Own(Emission<TextureHandle<Spectrum>>),
    Light(Arc<dyn Light>),
}

/// A shape, before `build`.
#[derive(Clone)]
pub(super) struct NewShape {
    pub name: String,
    pub mesh: TriangleMesh,
    pub material: NewMaterial,
    pub emission: Option<NewEmission>,
    /// Index of the shape that an instance would have shown, if it is a copy.
    pub copy_of: Option<usize>,
}

/// What a shape is made of, before `build`.
#[derive(Clone)]
pub(super) enum NewMaterial {
    /// All of it; `None` reflects nothing.
    Everywhere(Option<String>),
    /// Names, and which of them each triangle has.
    ByTriangle(Vec<String>, Vec<u32>),
}
