//! Materials: they evaluate textures at a hit and return lobes.

mod bump;
mod matte;
mod traits;

pub use bump::bump;
pub use matte::MatteMaterial;
pub use traits::{Material, Read};

use crate::params::Kind;

/// All kinds of materials of scene files.
pub static MATERIALS: &[Kind<Read>] = &[matte::KIND];
