//! Materials: they evaluate textures at a hit and return lobes.

mod bump;
mod glass;
mod matte;
mod medium;
mod mirror;
mod reflectance;
mod traits;

pub use bump::bump;
pub use glass::GlassMaterial;
pub use matte::MatteMaterial;
pub use mirror::MirrorMaterial;
pub use traits::{Material, Read};

use crate::params::Kind;

/// All kinds of materials of scene files.
pub static MATERIALS: &[Kind<Read>] = &[matte::KIND, mirror::KIND, glass::KIND];
