//! Materials of MTL files, as this crate's kinds.
//!
//! | what MTL says | material |
//! |---|---|
//! | `Pm` above 1/2 | metal that reflects `Kd` at the normal |
//! | `illum` 4, 6, 7 or 9 | glass of index `Ni`, 1.5 without one; refracted light is scaled by `Tf` |
//! | `illum` 3 or 5 with black `Kd`, and `Ks` | metal that reflects `Ks` |
//! | `Ks` above 0, with `illum` 2 or none | plastic: a coat of index `Ni`, 1.5 without one or with 1, over `Kd` |
//! | else | matte, `Kd` |
//!
//! Roughness is `Pr`, perceptual, or α = √(2 / (Ns + 2)) from Phong's exponent `Ns` (Walter et al. 2007, section 5.2), else 0.
//! `map_Kd` is multiplied by `Kd`, unless that is black.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::Vec2;

use super::{GlassMaterial, Material, MatteMaterial, MetalMaterial, PlasticMaterial, Roughness};
use crate::image::ReadError;
use crate::shape::{MtlMap, MtlMaterial};
use crate::spectrum::Spectrum;
use crate::texture::{
    Curve, ImageTexture, Mapping, ProductTexture, Texture, TextureHandle, Textures, Wrap,
};

/// Makes materials from those of an MTL file.
pub struct MtlMaterials<'a> {
    /// The folder of the file, to which names of images are relative.
    pub folder: &'a Path,
    /// The images that materials share.
    pub textures: &'a Textures,
}

/// What could not be used of a material, in a phrase.
pub type Note = String;

impl MtlMaterials<'_> {
    /// The material, and what was left out of it.
    pub fn make(&self, mtl: &MtlMaterial) -> (Arc<dyn Material>, Vec<Note>) {
        let mut notes = Vec::new();
        let kd = self.color(mtl.kd, mtl.map_kd.as_ref(), &mut notes);
        let ks = Spectrum::from(mtl.ks.unwrap_or_default());
        let eta = mtl.ni.filter(|ni| *ni > 1.0 && *ni <= 10.0).unwrap_or(1.5);
        let material: Arc<dyn Material> = match mtl.illum {
            _ if mtl.pm.is_some_and(|pm| pm > 0.5) => {
                let color = kd.constant().unwrap_or(Spectrum::WHITE);
                Arc::new(MetalMaterial::reflecting(color).with_roughness(roughness(mtl)))
            }
            Some(4 | 6 | 7 | 9) => {
                let tf = Spectrum::from(mtl.tf.unwrap_or([1.0; 3]));
                Arc::new(GlassMaterial::new(eta).with_kt(tf).with_roughness(roughness(mtl)))
            }
            Some(3 | 5) if kd.constant() == Some(Spectrum::BLACK) && !ks.is_black() => {
                Arc::new(MetalMaterial::reflecting(ks).with_roughness(roughness(mtl)))
            }
            None | Some(2) if !ks.is_black() => {
                Arc::new(PlasticMaterial::new(kd, eta).with_roughness(roughness(mtl)))
            }
            _ => Arc::new(MatteMaterial::new(kd)),
        };
        let unused = [
            ("map_d", &mtl.map_d),
            ("map_Pr", &mtl.map_pr),
            ("map_Pm", &mtl.map_pm),
            ("map_Bump", &mtl.map_bump),
            ("norm", &mtl.norm),
            ("map_Ke", &mtl.map_ke),
        ];
        let unused = unused.into_iter().filter(|(_, map)| map.is_some());
        notes.extend(unused.map(|(key, _)| format!("{key} is not used yet")));
        (material, notes)
    }

    /// A colour, an image, or their product.
    fn color(
        &self,
        color: Option<[f32; 3]>,
        map: Option<&MtlMap>,
        notes: &mut Vec<Note>,
    ) -> TextureHandle<Spectrum> {
        let given = color.map(Spectrum::from);
        let color = given.unwrap_or(Spectrum::splat(0.5));
        let Some(map) = map else { return color.into_handle() };
        match self.image(map, Curve::Srgb) {
            Err(error) => {
                notes.push(error.to_string());
                color.into_handle()
            }
            Ok(image) => match given.filter(|color| !color.is_black() && *color != Spectrum::WHITE)
            {
                Some(color) => ProductTexture::new(image, color).into_handle(),
                None => image.into_handle(),
            },
        }
    }

    fn image(&self, map: &MtlMap, curve: Curve) -> Result<ImageTexture, ReadError> {
        let [u, v, _] = map.scale;
        let [du, dv, _] = map.offset;
        let mapping = Mapping::default().scaled(Vec2::new(u, v)).moved(Vec2::new(du, dv));
        let image = ImageTexture::new(self.textures.image(&self.path(&map.file), curve)?);
        let image = image.with_mapping(mapping);
        Ok(if map.is_clamped { image.with_wrap(Wrap::Clamp) } else { image })
    }

    /// Names have either slash.
    fn path(&self, name: &str) -> PathBuf {
        let as_it_is = self.folder.join(name);
        if as_it_is.exists() { as_it_is } else { self.folder.join(name.replace('\\', "/")) }
    }
}

fn roughness(mtl: &MtlMaterial) -> Roughness {
    match (mtl.pr, mtl.ns) {
        (Some(pr), _) => Roughness::perceptual(pr.clamp(0.0, 1.0)),
        (None, Some(ns)) => Roughness::alpha((2.0 / (ns.max(0.0) + 2.0)).sqrt()),
        (None, None) => Roughness::smooth(),
    }
}
