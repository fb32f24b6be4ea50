//! [`GlassMaterial`]: a boundary between media that do not absorb, smooth or rough.

use std::sync::Arc;

use super::medium::Medium;
use super::roughness::{self, Roughness};
use super::scales::{self, Scales};
use super::shared::Shared;
use super::traits::Material;
use super::{Materials, Read};
use crate::bxdf::{Arena, BoundaryLosses, Bsdf, FresnelMicrofacet, FresnelSpecular};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;
use crate::texture::{Texture, Textures};

/// A boundary, as of glass, water or diamond: light is reflected or refracted by Fresnel's equations (PBRT 3rd edition, section 9.2.2). A
/// smooth one is [`FresnelSpecular`], a rough one [`FresnelMicrofacet`], which loses no light between its facets.
///
/// The normal points out of the medium: a mesh whose normals point inwards is a bubble. Where two media touch, the boundary is one
/// surface with the relative index, such as 1.33 / 1.5 for water in a glass.
#[doc(alias = "dielectric")]
#[derive(Clone)]
pub struct GlassMaterial {
    scales: Scales,
    eta: f32,
    /// Of a surface that is not smooth everywhere.
    rough: Option<(Roughness, Arc<BoundaryLosses>)>,
}

impl GlassMaterial {
    /// Glass that loses no energy. `eta` is the index of refraction inside, over that outside; it must be above 0.
    pub fn new(eta: f32) -> Self {
        Self { scales: Scales::white(), eta, rough: None }
    }

    /// Makes the surface rough: frosted glass.
    pub fn with_roughness(self, roughness: Roughness) -> Self {
        static LOSSES: Shared<BoundaryLosses> = Shared::new();
        let all = roughness.all();
        let losses = || LOSSES.get(self.eta, all, || BoundaryLosses::new(self.eta, all));
        let rough = (!roughness.is_smooth()).then(|| (roughness.clone(), losses()));
        Self { rough, ..self }
    }

    /// Scales what is reflected, by a fraction that is clamped to `[0, 1]` per band.
    pub fn with_kr(self, kr: impl Texture<Spectrum> + 'static) -> Self {
        Self { scales: Scales { kr: kr.into_handle(), ..self.scales }, ..self }
    }

    /// Scales what is refracted, by a fraction that is clamped to `[0, 1]` per band.
    pub fn with_kt(self, kt: impl Texture<Spectrum> + 'static) -> Self {
        Self { scales: Scales { kt: kt.into_handle(), ..self.scales }, ..self }
    }
}

impl Material for GlassMaterial {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = match &self.rough {
            Some((roughness, _)) => roughness.bsdf(si),
            None => Bsdf::isotropic(si),
        };
        if let Some([r, t]) = self.scales.at(si) {
            match &self.rough {
                Some((rough, losses)) => {
                    bsdf.add(FresnelMicrofacet::new(r, t, rough.at(si), losses))
                }
                None => bsdf.add(FresnelSpecular::new(r, t, self.eta)),
            };
        }
        bsdf
    }
}

/// 1.5 by default, as in PBRT.
const ETA: Key<Medium> = Key::new("eta", "index of refraction inside, over that outside")
    .range(0.1..=10.0)
    .default(Medium(1.5));

/// `type = "glass"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "glass",
    meaning: "A boundary that reflects and refracts, smooth or rough",
    keys: &[
        &ETA,
        scales::KEYS[0],
        scales::KEYS[1],
        roughness::KEYS[0],
        roughness::KEYS[1],
        roughness::KEYS[2],
    ],
    read,
};

fn read(table: &Table, textures: &Textures, _: &Materials) -> Result<Arc<dyn Material>, Fault> {
    let Medium(eta) = table.get(&ETA)?;
    let scales = scales::read(table, textures)?;
    let roughness = roughness::read(table, textures)?;
    Ok(Arc::new(GlassMaterial { scales, eta, rough: None }.with_roughness(roughness)))
}
