//! [`Picture`]: a developed film, ready to be shown or written.

use glam::{UVec2, Vec3};

use crate::Spectrum;

/// A rectangle of pixels: `min` belongs to it, `max` does not. y grows downwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// The first column and row.
    pub min: UVec2,
    /// One past the last column and row.
    pub max: UVec2,
}

impl Window {
    /// The window that covers an image of this size.
    pub const fn full(resolution: UVec2) -> Self {
        Self { min: UVec2::ZERO, max: resolution }
    }

    /// Columns and rows.
    pub fn size(&self) -> UVec2 {
        self.max - self.min
    }

    /// How many pixels it holds.
    pub fn area(&self) -> usize {
        self.size().x as usize * self.size().y as usize
    }
}

/// What a renderer knows about the first hit of each pixel, averaged over the samples that hit.
/// A pixel that no sample hits has zero in all of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers {
    /// Shading normals in world space, not normalised again after averaging.
    pub normal: Vec<Vec3>,
    /// Distance from the camera along the ray, in scene units.
    pub depth: Vec<f32>,
    /// Share of light that the surface reflects towards the camera under a uniform sky.
    pub albedo: Vec<Spectrum>,
}

/// A developed film: linear radiance by pixel, row by row from the top left of the window.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Columns and rows of the whole image.
    pub resolution: UVec2,
    /// The part of it that was rendered.
    pub window: Window,
    /// Mean radiance of each pixel of the window.
    pub color: Vec<Spectrum>,
    /// The first hits, when the render was asked for them.
    pub layers: Option<Layers>,
}

/// How a picture came about: written into the files as attributes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metadata {
    /// The scene, as the user named it.
    pub scene: String,
    /// The sampler's seed.
    pub seed: u64,
    /// Samples taken in each pixel.
    pub samples_per_pixel: u32,
    /// Wall-clock time of the rendering alone.
    pub seconds: f64,
}
