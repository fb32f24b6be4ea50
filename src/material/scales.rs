//! [`Scales`]: how much of what a boundary reflects and transmits is kept.

use super::reflectance::reflectance;
use crate::interaction::SurfaceInteraction;
use crate::params::{AnyKey, Fault, Key, Table};
use crate::spectrum::Spectrum;
use crate::texture::{Texture, TextureHandle, TextureKey, Textures};

/// Fractions of reflected and of transmitted light, white by default.
#[derive(Clone)]
pub struct Scales {
    pub kr: TextureHandle<Spectrum>,
    pub kt: TextureHandle<Spectrum>,
}

impl Scales {
    pub fn white() -> Self {
        let white = || TextureHandle::Constant(Spectrum::WHITE);
        Self { kr: white(), kt: white() }
    }

    /// Both, clamped to `[0, 1]` per band; `None` if they are black.
    #[inline]
    pub fn at(&self, si: &SurfaceInteraction) -> Option<[Spectrum; 2]> {
        let [r, t] = [&self.kr, &self.kt].map(|texture| reflectance(texture.evaluate(si)));
        (r.is_some() || t.is_some()).then(|| [r, t].map(Option::unwrap_or_default))
    }
}

const KR: TextureKey<Spectrum> = TextureKey::of(
    Key::new("kr", "scale of what is reflected").range(0.0..=1.0).default(Spectrum::WHITE),
);
const KT: TextureKey<Spectrum> = TextureKey::of(
    Key::new("kt", "scale of what is transmitted").range(0.0..=1.0).default(Spectrum::WHITE),
);

/// The keys of both.
pub const KEYS: [&dyn AnyKey; 2] = [&KR, &KT];

pub fn read(table: &Table, textures: &Textures) -> Result<Scales, Fault> {
    Ok(Scales { kr: textures.get(table, &KR)?, kt: textures.get(table, &KT)? })
}
