//! Textures: values that may change over a surface.

mod constant;
mod read;
mod traits;

pub use constant::ConstantTexture;
pub use read::{AnyTexture, Read, TextureKey, TextureValue, Textures};
pub use traits::{Texture, TextureHandle};

use crate::params::Kind;

/// All kinds of textures.
pub static TEXTURES: &[Kind<Read>] = &[constant::KIND];
