//! Textures: values that may vary over a surface.

mod constant;
mod read;
mod traits;

pub use constant::ConstantTexture;
pub use read::{AnyTexture, Read, TextureKey, TextureValue, Textures};
pub use traits::{Texture, TextureHandle};

use crate::params::Kind;

/// All kinds of textures of scene files.
pub static TEXTURES: &[Kind<Read>] = &[constant::KIND];
