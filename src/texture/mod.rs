//! Textures: values that may change over a surface.

mod constant;
mod read;

use std::sync::Arc;

pub use constant::ConstantTexture;
pub use read::{AnyTexture, Read, TextureKey, TextureValue, Textures};

use crate::interaction::SurfaceInteraction;
use crate::params::Kind;
use crate::spectrum::Spectrum;

/// All kinds of textures.
pub static TEXTURES: &[Kind<Read>] = &[constant::KIND];

/// A map from points of surfaces to values of type `T`: `f32` for roughness, displacement and the
/// like, [`Spectrum`] for colours.
///
/// ```
/// use lobe::interaction::SurfaceInteraction;
/// use lobe::texture::Texture;
///
/// /// Stripes along u, each of unit width.
/// struct Stripes;
///
/// impl Texture<f32> for Stripes {
///     fn evaluate(&self, si: &SurfaceInteraction) -> f32 {
///         si.uv().x.floor().rem_euclid(2.0)
///     }
/// }
/// ```
pub trait Texture<T>: Send + Sync {
    /// The value at a hit. What it does not ask the interaction for is not computed.
    fn evaluate(&self, si: &SurfaceInteraction) -> T;
}

/// A texture as a material holds it: a constant in place, or anyone's texture behind a pointer.
///
/// A constant is read without a call: `benches/shading.rs` has the figures.
#[derive(Clone)]
pub enum TextureHandle<T> {
    /// The same value everywhere.
    Constant(ConstantTexture<T>),
    /// A texture that may be shared between materials.
    Shared(Arc<dyn Texture<T>>),
}

impl<T: Copy + Send + Sync> TextureHandle<T> {
    /// The value at a hit.
    #[inline]
    pub fn evaluate(&self, si: &SurfaceInteraction) -> T {
        match self {
            Self::Constant(texture) => texture.evaluate(si),
            Self::Shared(texture) => texture.evaluate(si),
        }
    }

    /// The value if it is the same everywhere.
    pub(crate) fn constant(&self) -> Option<T> {
        match self {
            Self::Constant(texture) => Some(*texture.value()),
            Self::Shared(_) => None,
        }
    }
}

impl<T> From<ConstantTexture<T>> for TextureHandle<T> {
    fn from(texture: ConstantTexture<T>) -> Self {
        Self::Constant(texture)
    }
}

impl<T, X: Texture<T> + 'static> From<Arc<X>> for TextureHandle<T> {
    fn from(texture: Arc<X>) -> Self {
        Self::Shared(texture)
    }
}

impl From<f32> for TextureHandle<f32> {
    fn from(value: f32) -> Self {
        Self::Constant(ConstantTexture::new(value))
    }
}

impl From<Spectrum> for TextureHandle<Spectrum> {
    fn from(value: Spectrum) -> Self {
        Self::Constant(ConstantTexture::new(value))
    }
}

impl From<[f32; 3]> for TextureHandle<Spectrum> {
    fn from(value: [f32; 3]) -> Self {
        Self::Constant(ConstantTexture::new(value.into()))
    }
}
