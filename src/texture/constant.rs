//! [`ConstantTexture`]: the same value everywhere.

use super::{AnyTexture, Read, Texture, TextureValue, Textures};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Key, Kind, Limits, Param, Table, Value};
use crate::spectrum::Spectrum;

/// The same value at every point. It needs neither texture coordinates nor filtering.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantTexture<T> {
    value: T,
}

impl<T> ConstantTexture<T> {
    /// A texture of this value.
    pub const fn new(value: T) -> Self {
        Self { value }
    }
}

impl<T: Copy + Send + Sync> Texture<T> for ConstantTexture<T> {
    #[inline]
    fn evaluate(&self, _si: &SurfaceInteraction) -> T {
        self.value
    }

    fn constant(&self) -> Option<T> {
        Some(self.value)
    }
}

/// A number or a colour, as in a scene file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Constant {
    /// A number.
    Number(f32),
    /// A colour.
    Color(Spectrum),
}

impl From<Constant> for AnyTexture {
    fn from(constant: Constant) -> Self {
        match constant {
            Constant::Number(value) => Self::Number(value.everywhere()),
            Constant::Color(value) => Self::Color(value.everywhere()),
        }
    }
}

impl Param for Constant {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        let number = f32::from_value(value, limits).map(Self::Number);
        number.or_else(|| Spectrum::from_value(value, limits).map(Self::Color))
    }

    fn to_value(&self) -> Option<Value> {
        match self {
            Self::Number(value) => value.to_value(),
            Self::Color(value) => value.to_value(),
        }
    }

    fn expected(_: &Limits) -> String {
        "a number or [red, green, blue], all finite".into()
    }

    fn example(limits: &Limits) -> Self {
        Self::Color(Spectrum::example(limits))
    }
}

const VALUE: Key<Constant> = Key::new("value", "the number or the colour");

/// `type = "constant"`
pub(super) const KIND: Kind<Read> =
    Kind { name: "constant", meaning: "The same value everywhere", keys: &[&VALUE], read };

fn read(table: &Table, _: &Textures) -> Result<AnyTexture, Fault> {
    table.get(&VALUE).map(AnyTexture::from)
}
