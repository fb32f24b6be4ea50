//! [`DetailedMaterial`]: bumps, normals and holes that a mesh does not have.

use std::sync::Arc;

use super::bump::{bump, turn};
use super::opacity::product;
use super::traits::Material;
use crate::bxdf::{Arena, Bsdf, BsdfBlock};
use crate::interaction::{HitBlock, SurfaceInteraction};
use crate::params::{AnyKey, Fault, Key, Table};
use crate::spectrum::Spectrum;
use crate::texture::{Texture, TextureHandle, TextureKey, Textures};

/// A material on a surface with details that its mesh does not have: normals of an image, bumps, and holes.
///
/// ```
/// use lobe::MatteMaterial;
/// use lobe::interaction::SurfaceInteraction;
/// use lobe::material::DetailedMaterial;
///
/// let waves = |si: &SurfaceInteraction| 0.01 * (20.0 * si.uv().x).sin();
/// let round = |si: &SurfaceInteraction| if si.uv().length() < 1.0 { 1.0 } else { 0.0 };
/// let leaf = DetailedMaterial::new(MatteMaterial::new([0.1, 0.5, 0.1])).with_bump(waves).with_opacity(round);
/// ```
#[doc(alias = "alpha")]
#[doc(alias = "cut-out")]
#[doc(alias = "normal map")]
#[derive(Clone)]
pub struct DetailedMaterial {
    material: Arc<dyn Material>,
    normals: Option<TextureHandle<Spectrum>>,
    bump: Option<TextureHandle<f32>>,
    opacity: Option<TextureHandle<f32>>,
}

impl DetailedMaterial {
    /// Without details but the holes that the material has.
    pub fn new(material: impl Material + 'static) -> Self {
        let material = material.into_arc();
        let opacity = material.opacity().cloned();
        Self { material, normals: None, bump: None, opacity }
    }

    /// Takes shading normals from a texture, in the tangent space of the mesh: see [`turn`]. Bumps come on top of them.
    pub fn with_normals(self, normals: impl Texture<Spectrum> + 'static) -> Self {
        Self { normals: Some(normals.into_handle()), ..self }
    }

    /// Adds bump mapping by a displacement along the normal, in scene units. See [`bump`].
    pub fn with_bump(self, displacement: impl Texture<f32> + 'static) -> Self {
        Self { bump: Some(displacement.into_handle()), ..self }
    }

    /// Lets rays pass where the opacity is 0; where it is between 0 and 1, a part of them. If the material has holes, opacities are
    /// multiplied.
    pub fn with_opacity(self, opacity: impl Texture<f32> + 'static) -> Self {
        let opacity = opacity.into_handle();
        let opacity = match self.material.opacity() {
            Some(of_material) => product(of_material, &opacity),
            None => opacity,
        };
        Self { opacity: Some(opacity), ..self }
    }

    /// The material with the details of its table in a scene file, or as it is if there are none.
    ///
    /// # Errors
    /// Those of [`Textures::find`].
    pub fn read(
        table: &Table,
        textures: &Textures,
        material: Arc<dyn Material>,
    ) -> Result<Arc<dyn Material>, Fault> {
        let normals = textures.find(table, &NORMALS)?;
        let bump = textures.find(table, &BUMP)?;
        let opacity = textures.find(table, &OPACITY)?;
        if let (None, None, None) = (&normals, &bump, &opacity) {
            return Ok(material);
        }
        let detailed = Self { normals, bump, ..Self::new(material) };
        Ok(Arc::new(match opacity {
            Some(opacity) => detailed.with_opacity(opacity),
            None => detailed,
        }))
    }

    fn detail(&self, si: &mut SurfaceInteraction) {
        if let Some(normals) = &self.normals {
            turn(normals, si);
        }
        if let Some(displacement) = &self.bump {
            bump(displacement, si);
        }
    }
}

impl Material for DetailedMaterial {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, arena: &'a Arena) -> Bsdf<'a> {
        self.detail(si);
        self.material.compute_scattering(si, arena)
    }

    fn scatter_block<'a>(
        &'a self,
        hits: &mut HitBlock,
        arena: &'a Arena,
        bsdfs: &mut BsdfBlock<'a>,
    ) {
        if self.normals.is_none() && self.bump.is_none() {
            return self.material.scatter_block(hits, arena, bsdfs);
        }
        bsdfs.fill(hits, |_, si| self.compute_scattering(si, arena));
    }

    fn opacity(&self) -> Option<&TextureHandle<f32>> {
        self.opacity.as_ref().filter(|opacity| opacity.constant() != Some(1.0))
    }
}

const NORMALS: TextureKey<Option<Spectrum>> = TextureKey::of(
    Key::optional(
        "normals",
        "shading normals as the colours (n + 1) / 2, along u, along v and outwards: an image with the curve \"linear\"",
    )
    .range(0.0..=1.0),
);
const BUMP: TextureKey<Option<f32>> = TextureKey::of(Key::optional(
    "bump",
    "displacement along the normal, in scene units; a constant tilts nothing",
));
const OPACITY: TextureKey<Option<f32>> = TextureKey::of(
    Key::optional(
        "opacity",
        "where it is 0 rays pass, and in between a part of them; lamps have no holes",
    )
    .range(0.0..=1.0),
);

/// The keys of details, which all kinds of materials share.
pub static DETAILS: &[&dyn AnyKey] = &[&NORMALS, &BUMP, &OPACITY];
