//! [`PlasticMaterial`]: a coat over a diffuse base.

use std::sync::Arc;

use super::medium::Medium;
use super::reflectance::reflectance;
use super::roughness::{self, Roughness};
use super::shared::Shared;
use super::{Material, Materials, Read};
use crate::bxdf::fresnel::Fresnel;
use crate::bxdf::{Arena, Bsdf, BsdfBlock, Coated, CoatedDiffuse, Losses, MicrofacetReflection};
use crate::interaction::{BLOCK, HitBlock, SurfaceInteraction};
use crate::params::{Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;
use crate::texture::{Texture, TextureHandle, TextureKey, Textures};

/// A dielectric coat, smooth or rough, over a diffuse base: plastic, varnish, glazed porcelain. Both sides look alike.
///
/// Unlike PBRT's (3rd edition, section 9.2.2), which adds a glossy and a diffuse lobe, it divides light between them by Fresnel's equations:
/// [`MicrofacetReflection`] and [`CoatedDiffuse`]. A white base is white at every angle.
#[derive(Clone)]
pub struct PlasticMaterial {
    kd: TextureHandle<Spectrum>,
    eta: f32,
    roughness: Roughness,
    losses: Arc<Losses>,
}

impl PlasticMaterial {
    /// A smooth coat over a base that reflects the fraction `kd` of light, clamped to `[0, 1]` per band. `eta` is the coat's index of refraction,
    /// over that outside: at least 1.
    pub fn new(kd: impl Texture<Spectrum> + 'static, eta: f32) -> Self {
        let roughness = Roughness::smooth();
        let losses = losses(eta, &roughness);
        Self { kd: kd.into_handle(), eta, roughness, losses }
    }

    /// Makes the coat rough.
    pub fn with_roughness(self, roughness: Roughness) -> Self {
        let losses = losses(self.eta, &roughness);
        Self { roughness, losses, ..self }
    }
}

fn losses(eta: f32, roughness: &Roughness) -> Arc<Losses> {
    static LOSSES: Shared<Losses> = Shared::new();
    let all = roughness.all();
    LOSSES.get(eta, all, || Losses::of_coat(eta, all))
}

impl Material for PlasticMaterial {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = self.roughness.bsdf(si);
        let (alpha, eta) = (self.roughness.at(si), self.eta);
        bsdf.add(MicrofacetReflection::new(alpha, Fresnel::Dielectric { eta }));
        if let Some(r) = reflectance(self.kd.evaluate(si)) {
            bsdf.add(CoatedDiffuse::new(r, alpha, &self.losses));
        }
        bsdf
    }

    fn scatter_block<'a>(
        &'a self,
        hits: &mut HitBlock,
        arena: &'a Arena,
        bsdfs: &mut BsdfBlock<'a>,
    ) {
        if !self.roughness.is_isotropic() || !bsdfs.fill_alike(hits, self.coated_at(hits)) {
            bsdfs.fill(hits, |_, si| self.compute_scattering(si, arena));
        }
    }
}

impl PlasticMaterial {
    /// Coat and base at each hit of a block.
    #[inline]
    fn coated_at<'a>(&'a self, hits: &HitBlock) -> impl Fn(usize) -> Coated<'a> + use<'a> {
        // What a texture leaves out shows.
        let mut kd = [Spectrum::splat(f32::NAN); BLOCK];
        self.kd.evaluate_block(hits, &mut kd[..hits.len()]);
        let alpha = self.roughness.at_block(hits);
        let fresnel = Fresnel::Dielectric { eta: self.eta };
        move |i| {
            let base = reflectance(kd[i]).map(|r| CoatedDiffuse::new(r, alpha[i], &self.losses));
            Coated::new(MicrofacetReflection::new(alpha[i], fresnel), base, &self.losses)
        }
    }
}

const KD: TextureKey<Spectrum> = TextureKey::of(
    Key::new("kd", "fraction of light that the base reflects")
        .range(0.0..=1.0)
        .default(Spectrum::splat(0.5)),
);
const ETA: Key<Medium> = Key::new("eta", "index of refraction of the coat, over that outside")
    .range(1.0..=10.0)
    .default(Medium(1.5));

/// `type = "plastic"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "plastic",
    meaning: "A clear coat, smooth or rough, over a diffuse base",
    keys: &[&KD, &ETA, roughness::KEYS[0], roughness::KEYS[1], roughness::KEYS[2]],
    read,
};

fn read(table: &Table, textures: &Textures, _: &Materials) -> Result<Arc<dyn Material>, Fault> {
    let Medium(eta) = table.get(&ETA)?;
    let plastic = PlasticMaterial::new(textures.get(table, &KD)?, eta);
    Ok(Arc::new(plastic.with_roughness(roughness::read(table, textures)?)))
}
