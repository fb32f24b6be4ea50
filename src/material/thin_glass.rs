//! [`ThinGlassMaterial`]: a thin pane.

use std::sync::Arc;

use super::medium::Medium;
use super::reflectance::reflectance;
use super::{Material, Materials, Read};
use crate::bxdf::{Arena, Bsdf, ThinFresnelSpecular};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;
use crate::texture::{Texture, TextureHandle, TextureKey, Textures};

/// A pane of glass as one surface without thickness, as of a window or a bubble: light goes straight through ([`ThinFresnelSpecular`]).
#[doc(alias = "window")]
#[doc(alias = "thindielectric")]
#[derive(Clone)]
pub struct ThinGlassMaterial {
    kr: TextureHandle<Spectrum>,
    kt: TextureHandle<Spectrum>,
    eta: f32,
}

impl ThinGlassMaterial {
    /// A pane that loses no energy. `eta` is its index of refraction, over that around it; it must be above 0.
    pub fn new(eta: f32) -> Self {
        let white = || TextureHandle::Constant(Spectrum::WHITE);
        Self { kr: white(), kt: white(), eta }
    }

    /// Scales what is reflected, by a fraction that is clamped to `[0, 1]` per band.
    pub fn with_kr(self, kr: impl Texture<Spectrum> + 'static) -> Self {
        Self { kr: kr.into_handle(), ..self }
    }

    /// Scales what is transmitted, by a fraction that is clamped to `[0, 1]` per band.
    pub fn with_kt(self, kt: impl Texture<Spectrum> + 'static) -> Self {
        Self { kt: kt.into_handle(), ..self }
    }
}

impl Material for ThinGlassMaterial {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        let [r, t] = [&self.kr, &self.kt].map(|texture| reflectance(texture.evaluate(si)));
        if r.is_some() || t.is_some() {
            let [r, t] = [r, t].map(Option::unwrap_or_default);
            bsdf.add(ThinFresnelSpecular::new(r, t, self.eta));
        }
        bsdf
    }
}

const KR: TextureKey<Spectrum> = TextureKey::of(
    Key::new("kr", "scale of what is reflected").range(0.0..=1.0).default(Spectrum::WHITE),
);
const KT: TextureKey<Spectrum> = TextureKey::of(
    Key::new("kt", "scale of what is transmitted").range(0.0..=1.0).default(Spectrum::WHITE),
);
const ETA: Key<Medium> = Key::new("eta", "index of refraction, over that around it")
    .range(0.1..=10.0)
    .default(Medium(1.5));

/// `type = "thin-glass"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "thin-glass",
    meaning: "A pane without thickness, which light crosses straight",
    keys: &[&ETA, &KR, &KT],
    read,
};

fn read(table: &Table, textures: &Textures, _: &Materials) -> Result<Arc<dyn Material>, Fault> {
    let Medium(eta) = table.get(&ETA)?;
    let [kr, kt] = [textures.get(table, &KR)?, textures.get(table, &KT)?];
    Ok(Arc::new(ThinGlassMaterial::new(eta).with_kr(kr).with_kt(kt)))
}
