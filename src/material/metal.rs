//! [`MetalMaterial`]: smooth and rough metals.

use std::sync::{Arc, LazyLock};

use super::conductor::Conductor;
use super::facets::Facets;
use super::roughness::{self, Roughness};
use super::{Material, Materials, Read};
use crate::bxdf::fresnel::Fresnel;
use crate::bxdf::{Arena, Bsdf};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;
use crate::texture::{Texture, TextureHandle, TextureKey, Textures};

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
    /// What is reflected along the normal, in place of the Fresnel equations of `facets`.
    reflectance: Option<TextureHandle<Spectrum>>,
}

impl MetalMaterial {
    /// A smooth metal with the index of refraction `eta` + i `k`, over that of the medium outside.
    pub fn new(eta: Spectrum, k: Spectrum) -> Self {
        let fresnel = Fresnel::Conductor { eta: eta.to_array(), k: k.to_array() };
        Self { facets: Facets::new(fresnel), reflectance: None }
    }

    /// A smooth metal that reflects this fraction of light along its normal, clamped to `[0, 0.9999]` per band, as of index 1 (PBRT 4th
    /// edition, `ConductorMaterial`).
    pub fn reflecting(r: impl Texture<Spectrum> + 'static) -> Self {
        let r = r.into_handle();
        match r.constant() {
            Some(r) => Self::new(Spectrum::WHITE, absorption(r)),
            None => Self { reflectance: Some(r), ..Self::new(Spectrum::WHITE, Spectrum::WHITE) },
        }
    }

    /// A smooth metal of the list of scene files, such as "gold".
    pub fn named(name: &str) -> Option<Self> {
        Conductor::named(name).map(|Conductor { eta, k }| Self::new(eta.into(), k.into()))
    }

    /// Makes the surface rough.
    pub fn with_roughness(self, roughness: Roughness) -> Self {
        let facets = self.facets.with_roughness(roughness);
        if self.reflectance.is_some() && facets.is_rough() {
            // Now, not at the first hit of a render.
            LazyLock::force(&MEANS);
        }
        Self { facets, ..self }
    }
}

/// k of a metal of index 1 that reflects this fraction along its normal.
fn absorption(r: Spectrum) -> Spectrum {
    let k = r.to_array().map(|r| {
        let r = r.clamp(0.0, 0.9999);
        2.0 * (r / (1.0 - r)).sqrt()
    });
    k.into()
}

const STEPS: usize = 256;

/// What [`mean_of`] interpolates between.
static MEANS: LazyLock<Vec<f32>> = LazyLock::new(|| {
    let mean = |i: usize| {
        let k = absorption(Spectrum::splat(i as f32 / STEPS as f32));
        Fresnel::Conductor { eta: [1.0; 3], k: k.to_array() }.mean().max_component()
    };
    (0..=STEPS).map(mean).collect()
});

/// [`Fresnel::mean`] of metals of index 1, by the reflectance along the normal.
fn mean_of(r: Spectrum) -> Spectrum {
    let of_band = |r: f32| {
        let at = r.clamp(0.0, 1.0) * STEPS as f32;
        let first = (at as usize).min(STEPS - 1);
        MEANS[first] + (at - first as f32) * (MEANS[first + 1] - MEANS[first])
    };
    r.to_array().map(of_band).into()
}

impl Material for MetalMaterial {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let (mut bsdf, lobe) = match &self.reflectance {
            None => self.facets.at(si),
            Some(reflectance) => {
                let r = reflectance.evaluate(si);
                let (eta, k) = ([1.0; 3], absorption(r).to_array());
                // Smooth surfaces have no use for it.
                let mean = if self.facets.is_rough() { mean_of(r) } else { Spectrum::BLACK };
                self.facets.of(si, Fresnel::Conductor { eta, k }, mean)
            }
        };
        bsdf.add(lobe);
        bsdf
    }
}

/// Copper by default, as in PBRT.
const METAL: Key<Conductor> = Key::new("metal", "index of refraction eta and absorption k")
    .range(0.0..=100.0)
    .default(Conductor::COPPER);

const REFLECTANCE: TextureKey<Option<Spectrum>> = TextureKey::of(
    Key::optional(
        "reflectance",
        "fraction of light that is reflected along the normal, in place of metal: for textures",
    )
    .range(0.0..=1.0),
);

/// `type = "metal"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "metal",
    meaning: "A metal, smooth or rough",
    keys: &[&METAL, &REFLECTANCE, roughness::KEYS[0], roughness::KEYS[1], roughness::KEYS[2]],
    read,
};

fn read(table: &Table, textures: &Textures, _: &Materials) -> Result<Arc<dyn Material>, Fault> {
    let Conductor { eta, k } = table.get(&METAL)?;
    let metal = match textures.find(table, &REFLECTANCE)? {
        Some(reflectance) => MetalMaterial::reflecting(reflectance),
        None => MetalMaterial::new(eta.into(), k.into()),
    };
    Ok(Arc::new(metal.with_roughness(roughness::read(table, textures)?)))
}
