//! Materials: they evaluate textures at a hit and return lobes.

mod bump;
mod conductor;
mod detailed;
mod facets;
mod glass;
mod matte;
mod medium;
mod metal;
mod mirror;
mod mix;
mod mtl;
mod opacity;
mod plastic;
mod reflectance;
mod retro;
mod roughness;
mod scales;
mod shared;
mod thin_glass;
mod traits;
mod translucent;

pub use bump::{bump, turn};
pub use detailed::{DETAILS, DetailedMaterial};
pub use glass::GlassMaterial;
pub use matte::MatteMaterial;
pub use metal::MetalMaterial;
pub use mirror::MirrorMaterial;
pub use mix::MixMaterial;
pub use mtl::MtlMaterials;
pub use plastic::PlasticMaterial;
pub use retro::RetroMaterial;
pub use roughness::{Roughness, RoughnessScale};
pub use thin_glass::ThinGlassMaterial;
pub use traits::{Material, Materials, Read};
pub use translucent::TranslucentMaterial;

use crate::params::Kind;

/// All kinds of materials of scene files.
pub static MATERIALS: &[Kind<Read>] = &[
    matte::KIND,
    mirror::KIND,
    glass::KIND,
    thin_glass::KIND,
    metal::KIND,
    plastic::KIND,
    translucent::KIND,
    retro::KIND,
    mix::KIND,
];
