//! [`MatteMaterial`]: diffuse reflection.

use std::sync::Arc;

use super::reflectance::reflectance;
use super::{Material, Read, bump};
use crate::bxdf::{Arena, Bsdf, BsdfBlock, LambertianReflection, OrenNayar};
use crate::interaction::{BLOCK, HitBlock, SurfaceInteraction};
use crate::params::{Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;
use crate::texture::{Texture, TextureHandle, TextureKey, Textures};

/// Diffuse reflection, Lambertian or Oren-Nayar (PBRT 3rd edition, section 9.2.1).
///
/// ```
/// use lobe::material::MatteMaterial;
/// let clay = MatteMaterial::new([0.6, 0.3, 0.2]).with_sigma(20.0);
/// ```
#[doc(alias = "diffuse")]
#[doc(alias = "lambert")]
#[derive(Clone)]
pub struct MatteMaterial {
    kd: TextureHandle<Spectrum>,
    sigma: Option<TextureHandle<f32>>,
    bump: Option<TextureHandle<f32>>,
}

impl MatteMaterial {
    /// Lambertian reflection of the fraction `kd` of incident light, clamped to `[0, 1]` per band.
    pub fn new(kd: impl Texture<Spectrum> + 'static) -> Self {
        Self { kd: kd.into_handle(), sigma: None, bump: None }
    }

    /// Adds roughness: the standard deviation of the surface's slopes in degrees, clamped to `[0, 90]`. Where
    /// it is 0 the surface is Lambertian, elsewhere it is [`OrenNayar`].
    pub fn with_sigma(self, sigma: impl Texture<f32> + 'static) -> Self {
        Self { sigma: Some(sigma.into_handle()), ..self }
    }

    /// Adds bump mapping by a displacement along the normal, in scene units. See [`bump`].
    pub fn with_bump(self, displacement: impl Texture<f32> + 'static) -> Self {
        Self { bump: Some(displacement.into_handle()), ..self }
    }
}

impl Material for MatteMaterial {
    #[inline]
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        if let Some(displacement) = &self.bump {
            bump(displacement, si);
        }
        let mut bsdf = Bsdf::isotropic(si);
        if let Some(r) = reflectance(self.kd.evaluate(si)) {
            let sigma = self.sigma.as_ref().map_or(0.0, |s| s.evaluate(si).clamp(0.0, 90.0));
            if sigma == 0.0 {
                bsdf.add(LambertianReflection::new(r));
            } else {
                bsdf.add(OrenNayar::new(r, sigma));
            }
        }
        bsdf
    }

    fn scatter_block<'a>(
        &'a self,
        hits: &mut HitBlock,
        arena: &'a Arena,
        bsdfs: &mut BsdfBlock<'a>,
    ) {
        if self.bump.is_some() {
            return bsdfs.fill(hits, |_, si| self.compute_scattering(si, arena));
        }
        // A black lobe stands for no lobe. A sigma of 0 gives the bits of Lambertian reflection.
        let lambertian = |kd| LambertianReflection::new(reflectance(kd).unwrap_or_default());
        let rough = |kd, sigma: f32| match reflectance(kd) {
            Some(r) => OrenNayar::new(r, sigma.clamp(0.0, 90.0)),
            None => OrenNayar::new(Spectrum::BLACK, 0.0),
        };
        let constant_sigma = self.sigma.as_ref().map_or(Some(0.0), |sigma| sigma.constant());
        match (self.kd.constant(), constant_sigma) {
            (Some(kd), Some(0.0)) => bsdfs.fill_constant(hits, lambertian(kd)),
            (Some(kd), Some(sigma)) => bsdfs.fill_constant(hits, rough(kd, sigma)),
            _ => {
                // What a texture leaves out shows.
                let (mut kd, mut sigma) = ([Spectrum::splat(f32::NAN); BLOCK], [f32::NAN; BLOCK]);
                self.kd.evaluate_block(hits, &mut kd[..hits.len()]);
                if constant_sigma == Some(0.0) {
                    return bsdfs.fill_alike(hits, |i| lambertian(kd[i]));
                }
                if let Some(texture) = &self.sigma {
                    texture.evaluate_block(hits, &mut sigma[..hits.len()]);
                }
                bsdfs.fill_alike(hits, |i| rough(kd[i], sigma[i]));
            }
        }
    }
}

/// 0.5 by default, as in PBRT.
const KD: TextureKey<Spectrum> = TextureKey::of(
    Key::new("kd", "reflected fraction of the light")
        .range(0.0..=1.0)
        .default(Spectrum::splat(0.5)),
);
const SIGMA: TextureKey<f32> = TextureKey::of(
    Key::new("sigma", "roughness: standard deviation of the surface's slopes")
        .in_unit("degrees")
        .range(0.0..=90.0)
        .default(0.0),
);
const BUMP: TextureKey<Option<f32>> = TextureKey::of(Key::optional(
    "bump",
    "displacement along the normal, in scene units; a constant tilts nothing",
));

/// `type = "matte"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "matte",
    meaning: "Diffuse: Lambertian, or Oren-Nayar where sigma is not 0",
    keys: &[&KD, &SIGMA, &BUMP],
    read,
};

fn read(table: &Table, textures: &Textures) -> Result<Arc<dyn Material>, Fault> {
    let matte = MatteMaterial::new(textures.get(table, &KD)?);
    let matte = matte.with_sigma(textures.get(table, &SIGMA)?);
    Ok(match textures.find(table, &BUMP)? {
        Some(displacement) => Arc::new(matte.with_bump(displacement)),
        None => Arc::new(matte),
    })
}
