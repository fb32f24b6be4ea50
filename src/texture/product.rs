//! [`ProductTexture`]: a texture times another.

use std::ops::Mul;

use super::any::Pair;
use super::value::Constant;
use super::{AnyTexture, Read, Texture, TextureHandle, TextureKey, Textures};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Key, Kind, Table};

/// A texture times another (PBRT's scale texture, 3rd edition, section 10.3.2).
#[doc(alias = "scale")]
#[derive(Clone)]
pub struct ProductTexture<T> {
    factors: [TextureHandle<T>; 2],
}

impl<T> ProductTexture<T> {
    /// The product of two textures.
    pub fn new(a: impl Texture<T> + 'static, b: impl Texture<T> + 'static) -> Self {
        Self { factors: [a.into_handle(), b.into_handle()] }
    }
}

impl<T: Copy + Mul<Output = T> + Send + Sync + 'static> Texture<T> for ProductTexture<T> {
    fn evaluate(&self, si: &SurfaceInteraction) -> T {
        let [a, b] = &self.factors;
        a.evaluate(si) * b.evaluate(si)
    }

    fn constant(&self) -> Option<T> {
        let [a, b] = &self.factors;
        Some(a.constant()? * b.constant()?)
    }
}

const A: TextureKey<Constant> = TextureKey::of(Key::new("a", "the first factor"));
const B: TextureKey<Constant> = TextureKey::of(Key::new("b", "the second factor"));

/// `type = "product"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "product",
    meaning: "A texture times another; with a number, a scaled one",
    keys: &[&A, &B],
    read,
};

fn read(table: &Table, textures: &Textures) -> Result<AnyTexture, Fault> {
    Ok(match textures.pair(table, [&A, &B])? {
        Pair::Numbers([a, b]) => AnyTexture::Number(ProductTexture::new(a, b).into_handle()),
        Pair::Colors([a, b]) => AnyTexture::Color(ProductTexture::new(a, b).into_handle()),
    })
}
