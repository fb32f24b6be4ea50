//! [`AnyTexture`]: textures whose type of values is known at run time only.

use super::traits::{Texture, TextureHandle};
use super::value::Constant;
use crate::interaction::SurfaceInteraction;
use crate::params::Param;
use crate::spectrum::Spectrum;

/// A texture whose value type is known at run time only.
#[derive(Clone)]
#[non_exhaustive]
pub enum AnyTexture {
    /// With values of type `f32`.
    Number(TextureHandle<f32>),
    /// With values of type [`Spectrum`].
    Color(TextureHandle<Spectrum>),
}

impl AnyTexture {
    /// With numbers as greys.
    pub(super) fn into_color(self) -> TextureHandle<Spectrum> {
        match self {
            Self::Color(texture) => texture,
            Self::Number(TextureHandle::Constant(value)) => Spectrum::splat(value).everywhere(),
            Self::Number(texture) => {
                let grey = move |si: &SurfaceInteraction| Spectrum::splat(texture.evaluate(si));
                grey.into_handle()
            }
        }
    }

    /// Whether it is the same everywhere.
    pub(super) fn is_constant(&self) -> bool {
        match self {
            Self::Number(texture) => texture.constant().is_some(),
            Self::Color(texture) => texture.constant().is_some(),
        }
    }
}

impl From<Constant> for AnyTexture {
    fn from(constant: Constant) -> Self {
        match constant {
            Constant::Number(value) => Self::Number(value.everywhere()),
            Constant::Color(value) => Self::Color(value.everywhere()),
        }
    }
}

/// Two textures with values of one type.
pub(super) enum Pair {
    Numbers([TextureHandle<f32>; 2]),
    Colors([TextureHandle<Spectrum>; 2]),
}

/// A type of values that textures of scene files can have.
pub trait TextureValue: Param + Copy {
    /// The texture, if its values have this type or become it: numbers are greys.
    fn of(texture: &AnyTexture) -> Option<TextureHandle<Self>>;

    /// A constant texture of this value.
    fn everywhere(self) -> TextureHandle<Self>;
}

impl TextureValue for f32 {
    fn of(texture: &AnyTexture) -> Option<TextureHandle<Self>> {
        if let AnyTexture::Number(texture) = texture { Some(texture.clone()) } else { None }
    }

    fn everywhere(self) -> TextureHandle<Self> {
        TextureHandle::Constant(self)
    }
}

impl TextureValue for Spectrum {
    fn of(texture: &AnyTexture) -> Option<TextureHandle<Self>> {
        Some(texture.clone().into_color())
    }

    fn everywhere(self) -> TextureHandle<Self> {
        TextureHandle::Constant(self)
    }
}
