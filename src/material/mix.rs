//! [`MixMaterial`]: two materials in one.

use std::sync::Arc;

use super::opacity;
use super::{Material, Materials, Read};
use crate::bxdf::{Arena, Bsdf};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Key, Kind, Table};
use crate::texture::{Texture, TextureHandle, TextureKey, Textures};

/// The lobes of two materials, weighted (PBRT 3rd edition, section 9.2.3).
///
/// The shading normal is that of the first, unless the amount is 1. A surface has at most [`MAX_LOBES`](crate::bxdf::MAX_LOBES)
/// lobes: mixtures of mixtures that have more lose some, which is counted.
///
/// Where one of them lets rays pass, the mixture lets its part of them pass, and the lobes of what stops rays have its weight.
#[derive(Clone)]
pub struct MixMaterial {
    both: [Arc<dyn Material>; 2],
    amount: TextureHandle<f32>,
    /// `None` if neither lets rays pass.
    opacity: Option<TextureHandle<f32>>,
}

impl MixMaterial {
    /// The first material where `amount` is 0, the second where it is 1, clamped to `[0, 1]`.
    pub fn new(
        first: impl Material + 'static,
        second: impl Material + 'static,
        amount: impl Texture<f32> + 'static,
    ) -> Self {
        let (both, amount) = ([first.into_arc(), second.into_arc()], amount.into_handle());
        let opacity = opacity::mixed([both[0].opacity(), both[1].opacity()], &amount);
        Self { both, amount, opacity }
    }

    /// The part of the second in what stops rays.
    fn part(&self, si: &SurfaceInteraction) -> f32 {
        let amount = self.amount.evaluate(si).clamp(0.0, 1.0);
        let Some(opacity) = &self.opacity else { return amount };
        let of_second = self.both[1].opacity().map_or(1.0, |o| o.evaluate(si).clamp(0.0, 1.0));
        let all = opacity.evaluate(si);
        if all > 0.0 { (amount * of_second / all).min(1.0) } else { amount }
    }
}

impl Material for MixMaterial {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, arena: &'a Arena) -> Bsdf<'a> {
        let [first, second] = &self.both;
        let amount = self.part(si);
        if amount == 0.0 {
            return first.compute_scattering(si, arena);
        }
        if amount == 1.0 {
            return second.compute_scattering(si, arena);
        }
        let mut of_second = si.clone();
        let second = second.compute_scattering(&mut of_second, arena);
        first.compute_scattering(si, arena).mixed(1.0 - amount, &second, amount)
    }

    fn opacity(&self) -> Option<&TextureHandle<f32>> {
        self.opacity.as_ref()
    }
}

const FIRST: Key<String> = Key::new("first", "name of a material, defined above");
const SECOND: Key<String> = Key::new("second", "name of another, defined above");
const AMOUNT: TextureKey<f32> =
    TextureKey::of(Key::new("amount", "weight of the second").range(0.0..=1.0).default(0.5));

/// `type = "mix"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "mix",
    meaning: "Two materials, weighted",
    keys: &[&FIRST, &SECOND, &AMOUNT],
    read,
};

fn read(
    table: &Table,
    textures: &Textures,
    materials: &Materials,
) -> Result<Arc<dyn Material>, Fault> {
    let [first, second] = [materials.get(table, &FIRST)?, materials.get(table, &SECOND)?];
    Ok(Arc::new(MixMaterial::new(first, second, textures.get(table, &AMOUNT)?)))
}
