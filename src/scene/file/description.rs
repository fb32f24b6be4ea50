//! [`Description`]: what a scene file says, as plain values that refer to each other by name.

use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;

use glam::{Affine3A, Vec3};

use crate::camera::CameraSettings;
use crate::scene::{FilmSettings, IntegratorSettings, SamplerSettings};

/// A scene before its meshes are read. Lists are in the order of the file.
pub struct Description {
    pub camera: CameraSettings,
    pub film: FilmSettings,
    pub sampler: SamplerSettings,
    pub integrator: IntegratorSettings,
    pub textures: Vec<(String, TextureDescription)>,
    pub materials: Vec<(String, MaterialDescription)>,
    pub lights: Vec<LightDescription>,
    pub shapes: Vec<(String, ShapeDescription)>,
}

/// A texture's name, or a constant in place of one.
pub enum Source {
    Texture(String),
    Value(TextureDescription),
}

/// `[texture.NAME]`
#[derive(Clone, Copy)]
pub enum TextureDescription {
    /// The same number everywhere.
    ConstantNumber(f32),
    /// The same colour everywhere.
    ConstantColor([f32; 3]),
}

impl Display for TextureDescription {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Self::ConstantNumber(value) => write!(f, "{value}"),
            Self::ConstantColor([r, g, b]) => write!(f, "[{r}, {g}, {b}]"),
        }
    }
}

/// `[material.NAME]`
pub enum MaterialDescription {
    /// A [`MatteMaterial`](crate::MatteMaterial).
    Matte { kd: Source, sigma: Option<Source>, bump: Option<Source> },
}

/// `[light.NAME]`
pub enum LightDescription {
    /// A [`PointLight`](crate::PointLight).
    Point { position: Vec3, intensity: [f32; 3] },
}

/// `[shape.NAME]`
pub struct ShapeDescription {
    /// Where the mesh is.
    pub obj: PathBuf,
    /// The name of its material.
    pub material: String,
    /// From the mesh to the world.
    pub transform: Affine3A,
}
