//! [`TranslucentMaterial`]: diffuse on both sides.

use std::sync::Arc;

use super::reflectance::reflectance;
use super::{Material, Materials, Read};
use crate::bxdf::{Arena, Bsdf, LambertianReflection, LambertianTransmission};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;
use crate::texture::{Texture, TextureHandle, TextureKey, Textures};

/// A sheet that scatters light to both sides, as of paper, leaves or cloth (PBRT 3rd edition, section 9.2.5, without its glossy lobes).
#[derive(Clone)]
pub struct TranslucentMaterial {
    kd: TextureHandle<Spectrum>,
    transmission: TextureHandle<f32>,
}

impl TranslucentMaterial {
    /// Scatters the fraction `kd` of light, clamped to `[0, 1]` per band; of this, the fraction `transmission`, clamped to `[0, 1]`, to
    /// the other side.
    pub fn new(
        kd: impl Texture<Spectrum> + 'static,
        transmission: impl Texture<f32> + 'static,
    ) -> Self {
        Self { kd: kd.into_handle(), transmission: transmission.into_handle() }
    }
}

impl Material for TranslucentMaterial {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        if let Some(kd) = reflectance(self.kd.evaluate(si)) {
            let transmission = self.transmission.evaluate(si).clamp(0.0, 1.0);
            // Not false for NaN, which the Bsdf counts.
            if transmission != 1.0 {
                bsdf.add(LambertianReflection::new(kd * (1.0 - transmission)));
            }
            if transmission != 0.0 {
                bsdf.add(LambertianTransmission::new(kd * transmission));
            }
        }
        bsdf
    }
}

const KD: TextureKey<Spectrum> = TextureKey::of(
    Key::new("kd", "scattered fraction of the light")
        .range(0.0..=1.0)
        .default(Spectrum::splat(0.5)),
);
const TRANSMISSION: TextureKey<f32> = TextureKey::of(
    Key::new("transmission", "fraction of the scattered light that goes through")
        .range(0.0..=1.0)
        .default(0.5),
);

/// `type = "translucent"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "translucent",
    meaning: "A diffuse sheet that lets light through",
    keys: &[&KD, &TRANSMISSION],
    read,
};

fn read(table: &Table, textures: &Textures, _: &Materials) -> Result<Arc<dyn Material>, Fault> {
    let kd = textures.get(table, &KD)?;
    Ok(Arc::new(TranslucentMaterial::new(kd, textures.get(table, &TRANSMISSION)?)))
}
