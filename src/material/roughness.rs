//! [`Roughness`]: how rough the surface of a glossy material is.

use crate::bxdf::{Bsdf, Roughnesses};
use crate::interaction::{BLOCK, HitBlock, SurfaceInteraction};
use crate::params::{AnyKey, Choice, Fault, Key, Table};
use crate::texture::{Texture, TextureHandle, TextureKey, Textures};

/// How rough a surface is, along ∂p/∂u and across it.
///
/// ```
/// use lobe::material::Roughness;
/// let same_to_all_sides = Roughness::alpha(0.09);
/// let the_same = Roughness::perceptual(0.3);
/// let brushed = Roughness::alpha(0.3).across(0.05);
/// ```
#[derive(Clone)]
pub struct Roughness {
    along: TextureHandle<f32>,
    /// `None` if it is the same to all sides.
    across: Option<TextureHandle<f32>>,
    scale: RoughnessScale,
}

/// What a number of a roughness means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RoughnessScale {
    /// α of the distribution GGX, as in Mitsuba.
    Alpha,
    /// Its square root, with which equal steps look equal, as in MTL files and glTF.
    Perceptual,
}

impl Choice for RoughnessScale {
    const CHOICES: &'static [(&'static str, Self)] =
        &[("alpha", Self::Alpha), ("perceptual", Self::Perceptual)];
}

impl Roughness {
    /// A smooth surface.
    pub fn smooth() -> Self {
        Self::alpha(0.0)
    }

    /// The roughness α of the distribution [`Ggx`](crate::bxdf::Ggx), clamped to `[0, 1]`.
    pub fn alpha(alpha: impl Texture<f32> + 'static) -> Self {
        Self { along: alpha.into_handle(), across: None, scale: RoughnessScale::Alpha }
    }

    /// √α, clamped to `[0, 1]`.
    pub fn perceptual(roughness: impl Texture<f32> + 'static) -> Self {
        Self { scale: RoughnessScale::Perceptual, ..Self::alpha(roughness) }
    }

    /// Another roughness along ∂p/∂v, on the same scale: the reflection of brushed metal. Meshes need texture coordinates: without them, the
    /// direction changes from triangle to triangle.
    #[doc(alias = "anisotropic")]
    pub fn across(self, roughness: impl Texture<f32> + 'static) -> Self {
        Self { across: Some(roughness.into_handle()), ..self }
    }

    /// α along u and along v.
    #[inline]
    pub(super) fn at(&self, si: &SurfaceInteraction) -> [f32; 2] {
        let along = self.to_alpha(self.along.evaluate(si));
        let across = self.across.as_ref().map(|across| self.to_alpha(across.evaluate(si)));
        [along, across.unwrap_or(along)]
    }

    /// [`at`](Self::at) each hit of a block.
    #[inline]
    pub(super) fn at_block(&self, hits: &HitBlock) -> [[f32; 2]; BLOCK] {
        let of = |texture: &TextureHandle<f32>| {
            let mut alpha = [f32::NAN; BLOCK];
            texture.evaluate_block(hits, &mut alpha[..hits.len()]);
            for alpha in &mut alpha {
                *alpha = self.to_alpha(*alpha);
            }
            alpha
        };
        let along = of(&self.along);
        let across = self.across.as_ref().map(of).unwrap_or(along);
        std::array::from_fn(|i| [along[i], across[i]])
    }

    /// Whether the surface is the same to all sides.
    #[inline]
    pub(super) fn is_isotropic(&self) -> bool {
        self.across.is_none()
    }

    /// All that [`at`](Self::at) returns.
    pub(super) fn all(&self) -> Roughnesses {
        let along = self.along.constant();
        match (along, self.across.as_ref().map_or(along, |across| across.constant())) {
            (Some(along), Some(across)) => {
                Roughnesses::Constant([along, across].map(|roughness| self.to_alpha(roughness)))
            }
            _ => Roughnesses::Any,
        }
    }

    /// Whether the surface is smooth everywhere.
    pub(super) fn is_smooth(&self) -> bool {
        matches!(self.all(), Roughnesses::Constant([0.0, 0.0]))
    }

    /// A surface without lobes, in a frame that fits.
    #[inline]
    pub(super) fn bsdf<'a>(&self, si: &SurfaceInteraction) -> Bsdf<'a> {
        if self.across.is_some() { Bsdf::along_u(si) } else { Bsdf::isotropic(si) }
    }

    #[inline]
    fn to_alpha(&self, roughness: f32) -> f32 {
        let roughness = roughness.clamp(0.0, 1.0);
        match self.scale {
            RoughnessScale::Alpha => roughness,
            RoughnessScale::Perceptual => roughness * roughness,
        }
    }
}

const ROUGHNESS: TextureKey<f32> =
    TextureKey::of(Key::new("roughness", "roughness; 0 is smooth").range(0.0..=1.0).default(0.0));
const ACROSS: TextureKey<Option<f32>> = TextureKey::of(
    Key::optional(
        "roughness_v",
        "roughness along v, if it differs from that along u; the mesh needs texture coordinates",
    )
    .range(0.0..=1.0),
);
const SCALE: Key<RoughnessScale> = Key::new(
    "roughness_is",
    "what the number means: alpha of GGX, or perceptual, the square root of alpha",
)
.default(RoughnessScale::Alpha);

/// The keys of a roughness.
pub(super) const KEYS: [&dyn AnyKey; 3] = [&ROUGHNESS, &ACROSS, &SCALE];

pub(super) fn read(table: &Table, textures: &Textures) -> Result<Roughness, Fault> {
    Ok(Roughness {
        along: textures.get(table, &ROUGHNESS)?,
        across: textures.find(table, &ACROSS)?,
        scale: table.get(&SCALE)?,
    })
}
