//! [`Description`]: what a scene file says, as plain values that refer to each other by name.

use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;

use glam::{Affine3A, Vec3};

use crate::camera::PerspectiveSettings;
use crate::scene::{Emission, FilmSettings, IntegratorSettings, SamplerSettings};

/// A scene before its meshes are read. Lists are in the order of the file.
pub struct Description {
    pub camera: PerspectiveSettings,
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
    /// A [`DistantLight`](crate::light::DistantLight).
    Distant { direction: Vec3, irradiance: [f32; 3] },
    /// A [`SkyLight`](crate::light::SkyLight).
    Sky { radiance: [f32; 3] },
}

/// Where a shape's triangles come from.
pub enum ShapeSource {
    /// An OBJ file.
    Obj(PathBuf),
    /// A corner and the edges from there.
    Rectangle { corner: Vec3, edges: [Vec3; 2] },
}

/// `[shape.NAME]`
pub struct ShapeDescription {
    pub source: ShapeSource,
    /// The name of its material; none for a light that reflects nothing.
    pub material: Option<String>,
    pub emission: Option<Emission>,
    /// From the mesh to the world.
    pub transform: Affine3A,
}
