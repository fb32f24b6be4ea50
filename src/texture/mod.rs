//! Textures: values that may vary over a surface.

mod any;
mod channel;
mod checkerboard;
mod constant;
mod image;
mod mapping;
mod mix;
mod place;
mod product;
mod read;
mod texels;
mod texels_error;
mod traits;
mod value;
mod wrap;

pub use any::{AnyTexture, TextureValue};
pub use channel::Channel;
pub use checkerboard::CheckerboardTexture;
pub use constant::ConstantTexture;
pub use image::{ImageTexture, Magnification, Minification};
pub use mapping::{Mapping, Projection};
pub use mix::MixTexture;
pub use product::ProductTexture;
pub use read::{Read, TextureKey, Textures};
pub use texels::{Curve, Texels};
pub use texels_error::TexelsError;
pub use traits::{Texture, TextureHandle};
pub use wrap::Wrap;

use crate::params::Kind;

/// All kinds of textures of scene files.
pub static TEXTURES: &[Kind<Read>] =
    &[constant::KIND, image::KIND, checkerboard::KIND, product::KIND, mix::KIND];
