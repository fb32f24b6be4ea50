//! [`ThinGlassMaterial`]: a thin pane.

use std::sync::Arc;

use super::medium::Medium;
use super::scales::{self, Scales};
use super::{Material, Materials, Read};
use crate::bxdf::{Arena, Bsdf, ThinFresnelSpecular};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Key, Kind, Table};
use crate::spectrum::Spectrum;
use crate::texture::{Texture, Textures};

/// A pane of glass as one surface without thickness, as of a window or a bubble: light goes straight through ([`ThinFresnelSpecular`]).
#[doc(alias = "window")]
#[doc(alias = "thindielectric")]
#[derive(Clone)]
pub struct ThinGlassMaterial {
    scales: Scales,
    eta: f32,
}

impl ThinGlassMaterial {
    /// A pane that loses no energy. `eta` is its index of refraction, over that around it; it must be above 0.
    pub fn new(eta: f32) -> Self {
        Self { scales: Scales::white(), eta }
    }

    /// Scales what is reflected, by a fraction that is clamped to `[0, 1]` per band.
    pub fn with_kr(self, kr: impl Texture<Spectrum> + 'static) -> Self {
        Self { scales: Scales { kr: kr.into_handle(), ..self.scales }, ..self }
    }

    /// Scales what is transmitted, by a fraction that is clamped to `[0, 1]` per band.
    pub fn with_kt(self, kt: impl Texture<Spectrum> + 'static) -> Self {
        Self { scales: Scales { kt: kt.into_handle(), ..self.scales }, ..self }
    }
}

impl Material for ThinGlassMaterial {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        if let Some([r, t]) = self.scales.at(si) {
            bsdf.add(ThinFresnelSpecular::new(r, t, self.eta));
        }
        bsdf
    }
}

const ETA: Key<Medium> = Key::new("eta", "index of refraction, over that around it")
    .range(0.1..=10.0)
    .default(Medium(1.5));

/// `type = "thin-glass"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "thin-glass",
    meaning: "A pane without thickness, which light crosses straight",
    keys: &[&ETA, scales::KEYS[0], scales::KEYS[1]],
    read,
};

fn read(table: &Table, textures: &Textures, _: &Materials) -> Result<Arc<dyn Material>, Fault> {
    let Medium(eta) = table.get(&ETA)?;
    let scales = scales::read(table, textures)?;
    Ok(Arc::new(ThinGlassMaterial { scales, eta }))
}
