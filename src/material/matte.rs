//! [`MatteMaterial`]: diffuse reflection.

use std::sync::Arc;

use super::reflectance::reflectance;
use super::{Material, Materials, Read};
use crate::bxdf::{
    Arena, Bsdf, BsdfBlock, EnergyPreservingOrenNayar, LambertianReflection, OrenNayar, WideLobe,
};
use crate::interaction::{BLOCK, HitBlock, SurfaceInteraction};
use crate::params::{Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;
use crate::texture::{Texture, TextureHandle, TextureKey, Textures};

/// Diffuse reflection: Lambertian, or rough by one of two models (PBRT 3rd edition, section 9.2.1).
///
/// ```
/// use lobe::material::MatteMaterial;
/// let clay = MatteMaterial::new([0.6, 0.3, 0.2]).with_roughness(0.5);
/// // As in PBRT.
/// let dark = MatteMaterial::new([0.6, 0.3, 0.2]).with_sigma(20.0);
/// ```
#[doc(alias = "diffuse")]
#[doc(alias = "lambert")]
#[derive(Clone)]
pub struct MatteMaterial {
    kd: TextureHandle<Spectrum>,
    rough: Option<Rough>,
}

/// A model of rough surfaces and its parameter.
#[derive(Clone)]
enum Rough {
    OrenNayar(TextureHandle<f32>),
    EnergyPreserving(TextureHandle<f32>),
}

impl Rough {
    fn texture(&self) -> &TextureHandle<f32> {
        let (Self::OrenNayar(texture) | Self::EnergyPreserving(texture)) = self;
        texture
    }
}

impl MatteMaterial {
    /// Lambertian reflection of the fraction `kd` of incident light, clamped to `[0, 1]` per band.
    pub fn new(kd: impl Texture<Spectrum> + 'static) -> Self {
        Self { kd: kd.into_handle(), rough: None }
    }

    /// Makes the surface rough: the standard deviation of its slopes in degrees, clamped to `[0, 90]`. Where it is 0 the surface is
    /// Lambertian, elsewhere it is [`OrenNayar`], which loses energy. Replaces [`with_roughness`](Self::with_roughness).
    pub fn with_sigma(self, sigma: impl Texture<f32> + 'static) -> Self {
        Self { rough: Some(Rough::OrenNayar(sigma.into_handle())), ..self }
    }

    /// Makes the surface rough without a loss of energy: [`EnergyPreservingOrenNayar`], with a roughness that is clamped to `[0, 1]`.
    /// Replaces [`with_sigma`](Self::with_sigma).
    pub fn with_roughness(self, roughness: impl Texture<f32> + 'static) -> Self {
        Self { rough: Some(Rough::EnergyPreserving(roughness.into_handle())), ..self }
    }
}

impl Material for MatteMaterial {
    #[inline]
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        if let Some(r) = reflectance(self.kd.evaluate(si)) {
            let rough = self.rough.as_ref().map(|rough| (rough, rough.texture().evaluate(si)));
            match rough {
                Some((Rough::EnergyPreserving(_), roughness)) => bsdf.add(eon(r, roughness)),
                Some((Rough::OrenNayar(_), sigma)) if sigma.clamp(0.0, 90.0) != 0.0 => {
                    bsdf.add(oren_nayar(r, sigma))
                }
                _ => bsdf.add(LambertianReflection::new(r)),
            };
        }
        bsdf
    }

    fn scatter_block<'a>(&'a self, hits: &mut HitBlock, _: &'a Arena, bsdfs: &mut BsdfBlock<'a>) {
        match &self.rough {
            Some(Rough::EnergyPreserving(_)) => self.fill(hits, bsdfs, eon),
            // A sigma of 0 gives the bits of Lambertian reflection.
            Some(Rough::OrenNayar(sigma)) if sigma.constant() != Some(0.0) => {
                self.fill(hits, bsdfs, oren_nayar);
            }
            _ => self.fill(hits, bsdfs, |kd, _| {
                LambertianReflection::new(reflectance(kd).unwrap_or_default())
            }),
        }
    }
}

impl MatteMaterial {
    /// Fills a block with the lobes that `lobe` makes of kd and the parameter of roughness.
    #[inline]
    fn fill<'a, L>(
        &self,
        hits: &HitBlock,
        bsdfs: &mut BsdfBlock<'a>,
        lobe: impl Fn(Spectrum, f32) -> L,
    ) where
        L: Into<WideLobe<'a>>,
    {
        let texture = self.rough.as_ref().map(Rough::texture);
        let constant = texture.map_or(Some(0.0), |texture| texture.constant());
        if let (Some(kd), Some(parameter)) = (self.kd.constant(), constant) {
            return bsdfs.fill_constant(hits, lobe(kd, parameter));
        }
        // What a texture leaves out shows.
        let mut kd = [Spectrum::splat(f32::NAN); BLOCK];
        let mut parameter = [constant.unwrap_or(f32::NAN); BLOCK];
        self.kd.evaluate_block(hits, &mut kd[..hits.len()]);
        if let (Some(texture), None) = (texture, constant) {
            texture.evaluate_block(hits, &mut parameter[..hits.len()]);
        }
        bsdfs.fill_alike(hits, |i| lobe(kd[i], parameter[i]).into());
    }
}

/// A black lobe stands for no lobe.
fn oren_nayar(kd: Spectrum, sigma: f32) -> OrenNayar {
    match reflectance(kd) {
        Some(r) => OrenNayar::new(r, sigma.clamp(0.0, 90.0)),
        None => OrenNayar::new(Spectrum::BLACK, 0.0),
    }
}

/// A black lobe stands for no lobe.
fn eon(kd: Spectrum, roughness: f32) -> EnergyPreservingOrenNayar {
    match reflectance(kd) {
        Some(r) => EnergyPreservingOrenNayar::new(r, roughness.clamp(0.0, 1.0)),
        None => EnergyPreservingOrenNayar::new(Spectrum::BLACK, 0.0),
    }
}

/// 0.5 by default, as in PBRT.
const KD: TextureKey<Spectrum> = TextureKey::of(
    Key::new("kd", "reflected fraction of the light")
        .range(0.0..=1.0)
        .default(Spectrum::splat(0.5)),
);
const SIGMA: TextureKey<f32> = TextureKey::of(
    Key::new(
        "sigma",
        "roughness as in PBRT, which loses energy: standard deviation of the surface's slopes",
    )
    .in_unit("degrees")
    .range(0.0..=90.0)
    .default(0.0),
);
const ROUGHNESS: TextureKey<Option<f32>> = TextureKey::of(
    Key::optional("roughness", "roughness that loses no energy, in place of sigma")
        .range(0.0..=1.0),
);

/// `type = "matte"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "matte",
    meaning: "Diffuse: Lambertian, or rough by one of two models",
    keys: &[&KD, &ROUGHNESS, &SIGMA],
    read,
};

fn read(table: &Table, textures: &Textures, _: &Materials) -> Result<Arc<dyn Material>, Fault> {
    let matte = MatteMaterial::new(textures.get(table, &KD)?);
    let sigma = textures.get(table, &SIGMA)?;
    let matte = match textures.find(table, &ROUGHNESS)? {
        None => matte.with_sigma(sigma),
        Some(_) if sigma.constant() != Some(0.0) => return Err(two_models(table)),
        Some(roughness) => matte.with_roughness(roughness),
    };
    Ok(Arc::new(matte))
}

/// Both kinds of roughness.
fn two_models(table: &Table) -> Fault {
    match table.value(&SIGMA) {
        Ok(Some(node)) => {
            table.unfit(&SIGMA, node, node.value.to_string(), "no sigma beside a roughness".into())
        }
        Ok(None) => table.missing(&SIGMA),
        Err(fault) => fault,
    }
}
