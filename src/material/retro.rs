//! [`RetroMaterial`]: reflects light back to where it came from.

use std::sync::Arc;

use super::facets::Facets;
use super::reflectance::reflectance;
use super::roughness::{self, Roughness};
use super::{Material, Materials, Read};
use crate::bxdf::fresnel::Fresnel;
use crate::bxdf::{Arena, Bsdf, RetroReflection};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;
use crate::texture::{Texture, TextureHandle, TextureKey, Textures};

/// Glossy reflection, part of it back to where light came from, as of road signs and safety vests: [`RetroReflection`] beside
/// [`MicrofacetReflection`](crate::bxdf::MicrofacetReflection). Neither loses light between facets.
#[derive(Clone)]
pub struct RetroMaterial {
    kr: TextureHandle<Spectrum>,
    weight: TextureHandle<f32>,
    facets: Facets,
}

impl RetroMaterial {
    /// A smooth surface that reflects the fraction `kr` of light, clamped to `[0, 1]` per band; of this, the fraction `weight`, clamped to
    /// `[0, 1]`, back.
    pub fn new(kr: impl Texture<Spectrum> + 'static, weight: impl Texture<f32> + 'static) -> Self {
        let facets = Facets::new(Fresnel::NoOp);
        Self { kr: kr.into_handle(), weight: weight.into_handle(), facets }
    }

    /// Makes the surface rough.
    pub fn with_roughness(self, roughness: Roughness) -> Self {
        Self { facets: self.facets.with_roughness(roughness), ..self }
    }
}

impl Material for RetroMaterial {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let (mut bsdf, lobe) = self.facets.at(si);
        if let Some(kr) = reflectance(self.kr.evaluate(si)) {
            let weight = self.weight.evaluate(si).clamp(0.0, 1.0);
            // Not false for NaN, which the Bsdf counts.
            if weight != 0.0 {
                bsdf.add_scaled(RetroReflection::new(lobe), kr * weight);
            }
            if weight != 1.0 {
                bsdf.add_scaled(lobe, kr * (1.0 - weight));
            }
        }
        bsdf
    }
}

const KR: TextureKey<Spectrum> = TextureKey::of(
    Key::new("kr", "reflected fraction of the light")
        .range(0.0..=1.0)
        .default(Spectrum::splat(0.9)),
);
const WEIGHT: TextureKey<f32> = TextureKey::of(
    Key::new("weight", "fraction of the reflected light that goes back to its source")
        .range(0.0..=1.0)
        .default(1.0),
);

/// `type = "retro"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "retro",
    meaning: "Glossy reflection back to where light came from",
    keys: &[&KR, &WEIGHT, roughness::KEYS[0], roughness::KEYS[1], roughness::KEYS[2]],
    read,
};

fn read(table: &Table, textures: &Textures, _: &Materials) -> Result<Arc<dyn Material>, Fault> {
    let retro = RetroMaterial::new(textures.get(table, &KR)?, textures.get(table, &WEIGHT)?);
    Ok(Arc::new(retro.with_roughness(roughness::read(table, textures)?)))
}
