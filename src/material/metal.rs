//! [`MetalMaterial`]: smooth and rough metals.

use std::sync::Arc;

use super::conductor::Conductor;
use super::facets::Facets;
use super::roughness::{self, Roughness};
use super::{Material, Materials, Read};
use crate::bxdf::fresnel::Fresnel;
use crate::bxdf::{Arena, Bsdf};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;
use crate::texture::Textures;

/// A metal, on both sides, which loses no light between its facets: [`MicrofacetReflection`](crate::bxdf::MicrofacetReflection)
/// with Fresnel's equations for conductors (PBRT 3rd
/// edition, section 9.2.3, there without multiple scattering).
///
/// ```
/// use lobe::Spectrum;
/// use lobe::material::{MetalMaterial, Roughness};
/// let gold = MetalMaterial::named("gold").unwrap();
/// let gilding = MetalMaterial::new(Spectrum::new(0.2, 0.4, 1.3), Spectrum::new(3.2, 2.5, 1.9));
/// let brushed = gilding.with_roughness(Roughness::alpha(0.3).across(0.05));
/// ```
#[doc(alias = "conductor")]
#[derive(Clone)]
pub struct MetalMaterial {
    facets: Facets,
}

impl MetalMaterial {
    /// A smooth metal with the index of refraction `eta` + i `k`, over that of the medium outside.
    pub fn new(eta: Spectrum, k: Spectrum) -> Self {
        let fresnel = Fresnel::Conductor { eta: eta.to_array(), k: k.to_array() };
        Self { facets: Facets::new(fresnel) }
    }

    /// A smooth metal that reflects this fraction of light along its normal, clamped to `[0, 0.9999]` per band, as of index 1 (PBRT 4th
    /// edition, `ConductorMaterial`).
    pub fn reflecting(r: Spectrum) -> Self {
        let k = r.to_array().map(|r| {
            let r = r.clamp(0.0, 0.9999);
            2.0 * (r / (1.0 - r)).sqrt()
        });
        Self::new(Spectrum::WHITE, k.into())
    }

    /// A smooth metal of the list of scene files, such as "gold".
    pub fn named(name: &str) -> Option<Self> {
        Conductor::named(name).map(|Conductor { eta, k }| Self::new(eta.into(), k.into()))
    }

    /// Makes the surface rough.
    pub fn with_roughness(self, roughness: Roughness) -> Self {
        Self { facets: self.facets.with_roughness(roughness) }
    }
}

impl Material for MetalMaterial {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let (mut bsdf, lobe) = self.facets.at(si);
        bsdf.add(lobe);
        bsdf
    }
}

/// Copper by default, as in PBRT.
const METAL: Key<Conductor> = Key::new("metal", "index of refraction eta and absorption k")
    .range(0.0..=100.0)
    .default(Conductor::COPPER);

/// `type = "metal"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "metal",
    meaning: "A metal, smooth or rough",
    keys: &[&METAL, roughness::KEYS[0], roughness::KEYS[1], roughness::KEYS[2]],
    read,
};

fn read(table: &Table, textures: &Textures, _: &Materials) -> Result<Arc<dyn Material>, Fault> {
    let Conductor { eta, k } = table.get(&METAL)?;
    let metal = MetalMaterial::new(eta.into(), k.into());
    Ok(Arc::new(metal.with_roughness(roughness::read(table, textures)?)))
}
