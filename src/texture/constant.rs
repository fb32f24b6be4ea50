//! [`ConstantTexture`]: the same value everywhere.

use super::value::Constant;
use super::{AnyTexture, Read, Texture, Textures};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Key, Kind, Table};

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

const VALUE: Key<Constant> = Key::new("value", "the number or the colour");

/// `type = "constant"`
pub(super) const KIND: Kind<Read> =
    Kind { name: "constant", meaning: "The same value everywhere", keys: &[&VALUE], read };

fn read(table: &Table, _: &Textures) -> Result<AnyTexture, Fault> {
    table.get(&VALUE).map(AnyTexture::from)
}
