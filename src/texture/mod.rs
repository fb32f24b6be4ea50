//! Textures: values that may change over a surface.

mod constant;
mod traits;

pub use constant::ConstantTexture;
pub use traits::{Texture, TextureHandle};
