//! [`MirrorMaterial`]: a perfect mirror.

use std::sync::Arc;

use super::reflectance::reflectance;
use super::traits::Material;
use super::{Materials, Read};
use crate::bxdf::fresnel::Fresnel;
use crate::bxdf::{Arena, Bsdf, SpecularReflection};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;
use crate::texture::{Texture, TextureHandle, TextureKey, Textures};

/// A perfect mirror on both sides (PBRT 3rd edition, section 9.2.2, without a choice of Fresnel equations).
#[derive(Clone)]
pub struct MirrorMaterial {
    kr: TextureHandle<Spectrum>,
}

impl MirrorMaterial {
    /// Reflects the fraction `kr`, clamped to `[0, 1]` per band.
    pub fn new(kr: impl Texture<Spectrum> + 'static) -> Self {
        Self { kr: kr.into_handle() }
    }
}

impl Material for MirrorMaterial {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        if let Some(r) = reflectance(self.kr.evaluate(si)) {
            bsdf.add(SpecularReflection::new(r, Fresnel::NoOp));
        }
        bsdf
    }
}

/// 0.9 by default, as in PBRT.
const KR: TextureKey<Spectrum> = TextureKey::of(
    Key::new("kr", "reflected fraction of the light")
        .range(0.0..=1.0)
        .default(Spectrum::splat(0.9)),
);

/// `type = "mirror"`
pub(super) const KIND: Kind<Read> =
    Kind { name: "mirror", meaning: "A perfect mirror", keys: &[&KR], read };

fn read(table: &Table, textures: &Textures, _: &Materials) -> Result<Arc<dyn Material>, Fault> {
    Ok(Arc::new(MirrorMaterial::new(textures.get(table, &KR)?)))
}
