//! [`MixTexture`]: between two textures.

use std::ops::{Add, Mul};

use super::any::Pair;
use super::value::Constant;
use super::{AnyTexture, Read, Texture, TextureHandle, TextureKey, Textures};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Key, Kind, Table};

/// Linear interpolation between two textures by a third (PBRT 3rd edition, section 10.3.3).
#[derive(Clone)]
pub struct MixTexture<T> {
    ends: [TextureHandle<T>; 2],
    amount: TextureHandle<f32>,
}

impl<T> MixTexture<T> {
    /// The first texture where `amount` is 0, the second where it is 1.
    pub fn new(
        first: impl Texture<T> + 'static,
        second: impl Texture<T> + 'static,
        amount: impl Texture<f32> + 'static,
    ) -> Self {
        let ends = [first.into_handle(), second.into_handle()];
        Self { ends, amount: amount.into_handle() }
    }
}

impl<T> Texture<T> for MixTexture<T>
where
    T: Copy + Add<Output = T> + Mul<f32, Output = T> + Send + Sync + 'static,
{
    fn evaluate(&self, si: &SurfaceInteraction) -> T {
        let [first, second] = &self.ends;
        let amount = self.amount.evaluate(si);
        first.evaluate(si) * (1.0 - amount) + second.evaluate(si) * amount
    }

    fn constant(&self) -> Option<T> {
        let ([first, second], amount) = (&self.ends, self.amount.constant()?);
        Some(first.constant()? * (1.0 - amount) + second.constant()? * amount)
    }
}

const FIRST: TextureKey<Constant> = TextureKey::of(Key::new("first", "where the amount is 0"));
const SECOND: TextureKey<Constant> = TextureKey::of(Key::new("second", "where the amount is 1"));
const AMOUNT: TextureKey<f32> =
    TextureKey::of(Key::new("amount", "how much of the second").range(0.0..=1.0).default(0.5));

/// `type = "mix"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "mix",
    meaning: "Between two textures, by a third",
    keys: &[&FIRST, &SECOND, &AMOUNT],
    read,
};

fn read(table: &Table, textures: &Textures) -> Result<AnyTexture, Fault> {
    let amount = textures.get(table, &AMOUNT)?;
    Ok(match textures.pair(table, [&FIRST, &SECOND])? {
        Pair::Numbers([a, b]) => AnyTexture::Number(MixTexture::new(a, b, amount).into_handle()),
        Pair::Colors([a, b]) => AnyTexture::Color(MixTexture::new(a, b, amount).into_handle()),
    })
}
