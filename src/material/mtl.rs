//! Materials of MTL files, as this crate's kinds.
//!
//! | what MTL says | material |
//! |---|---|
//! | `Pm` above 1/2 | metal that reflects `Kd` at the normal, white without it |
//! | `illum` 4, 6, 7 or 9 | glass of index `Ni`; refracted light is scaled by `Tf` |
//! | `illum` 3 or 5 with black `Kd`, and `Ks` | metal that reflects `Ks` |
//! | `Ks` above 0, with `illum` 2, 3, 5, 8 or none | plastic: a coat of index `Ni` over `Kd` |
//! | else | matte, `Kd` |
//!
//! The first row that fits holds. An index that is missing, at most 1 or above 10 is 1.5, and a missing `Kd` is 0.5. Roughness is `Pr`, perceptual, or α = √(2 / (Ns + 2)) from Phong's exponent `Ns` (Walter et al. 2007, section 5.2), else 0.
//! Where the opacity, `d` or 1 - `Tr`, is below 1 and there is no glass, the rest of the material is a thin pane, through which light goes straight:
//! of index `Ni` if there is `Ks`, else one that reflects nothing; what it lets through is scaled by `Tf`.
//! `map_Kd` is multiplied by `Kd`, unless that is black.

use std::path::Path;
use std::sync::Arc;

use glam::Vec2;

use super::{
    GlassMaterial, Material, MatteMaterial, MetalMaterial, MixMaterial, PlasticMaterial, Roughness,
    ThinGlassMaterial,
};
use crate::file;
use crate::image::ReadError;
use crate::interaction::SurfaceInteraction;
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
        let has_glass = matches!(mtl.illum, Some(4 | 6 | 7 | 9));
        let is_metal = mtl.pm.is_some_and(|pm| pm > 0.5);
        // Neither glass nor metal has a place for it.
        let map = mtl.map_kd.as_ref().filter(|_| !has_glass && !is_metal);
        let kd = self.color(mtl.kd, map, &mut notes);
        let ks = Spectrum::from(mtl.ks.unwrap_or_default());
        let eta = mtl.ni.filter(|ni| *ni > 1.0 && *ni <= 10.0).unwrap_or(1.5);
        let filter = Spectrum::from(mtl.tf.unwrap_or([1.0; 3]));
        let material: Arc<dyn Material> = match mtl.illum {
            _ if is_metal => {
                let color = mtl.kd.map_or(Spectrum::WHITE, Spectrum::from);
                Arc::new(MetalMaterial::reflecting(color).with_roughness(roughness(mtl)))
            }
            _ if has_glass => {
                Arc::new(GlassMaterial::new(eta).with_kt(filter).with_roughness(roughness(mtl)))
            }
            Some(3 | 5) if kd.constant() == Some(Spectrum::BLACK) && !ks.is_black() => {
                Arc::new(MetalMaterial::reflecting(ks).with_roughness(roughness(mtl)))
            }
            None | Some(2 | 3 | 5 | 8) if !ks.is_black() => {
                Arc::new(PlasticMaterial::new(kd, eta).with_roughness(roughness(mtl)))
            }
            _ => Arc::new(MatteMaterial::new(kd)),
        };
        let material = match opacity(mtl) {
            // Glass lets light through by itself.
            opacity if opacity < 1.0 && !has_glass => {
                let eta = if ks.is_black() { 1.0 } else { eta };
                let pane = ThinGlassMaterial::new(eta).with_kt(filter);
                Arc::new(MixMaterial::new(pane, material, opacity))
            }
            _ => material,
        };
        let unused = [
            ("map_Kd", mtl.map_kd.is_some() && map.is_none()),
            ("map_d", mtl.map_d.is_some()),
            ("map_Pr", mtl.map_pr.is_some()),
            ("map_Pm", mtl.map_pm.is_some()),
            ("map_Bump", mtl.map_bump.is_some()),
            ("norm", mtl.norm.is_some()),
            ("map_Ke", mtl.map_ke.is_some()),
        ];
        let unused = unused.into_iter().filter(|(_, is_there)| *is_there);
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
        let image = match self.image(map, Curve::Srgb) {
            Err(error) => {
                notes.push(error.to_string());
                return color.into_handle();
            }
            Ok(image) if map.base_gain == [0.0, 1.0] => image.into_handle(),
            Ok(image) => {
                let [base, gain] = map.base_gain;
                let changed = move |si: &SurfaceInteraction| {
                    Spectrum::splat(base) + image.evaluate(si) * gain
                };
                changed.into_handle()
            }
        };
        match given.filter(|color| !color.is_black() && *color != Spectrum::WHITE) {
            Some(color) => ProductTexture::new(image, color).into_handle(),
            None => image,
        }
    }

    fn image(&self, map: &MtlMap, curve: Curve) -> Result<ImageTexture, ReadError> {
        let [u, v, _] = map.scale;
        let [du, dv, _] = map.offset;
        let mapping = Mapping::default().scaled(Vec2::new(u, v)).moved(Vec2::new(du, dv));
        // The message about a missing file names it as it stands there.
        let path = file::find(self.folder, &map.file);
        let path = path.unwrap_or_else(|| self.folder.join(&map.file));
        let image = ImageTexture::new(self.textures.image(&path, curve)?);
        let image = image.with_mapping(mapping);
        Ok(if map.is_clamped { image.with_wrap(Wrap::Clamp) } else { image })
    }
}

/// `d`, or 1 - `Tr`.
fn opacity(mtl: &MtlMaterial) -> f32 {
    mtl.d.or(mtl.tr.map(|tr| 1.0 - tr)).unwrap_or(1.0).clamp(0.0, 1.0)
}

fn roughness(mtl: &MtlMaterial) -> Roughness {
    match (mtl.pr, mtl.ns) {
        (Some(pr), _) => Roughness::perceptual(pr.clamp(0.0, 1.0)),
        (None, Some(ns)) => Roughness::alpha((2.0 / (ns.max(0.0) + 2.0)).sqrt()),
        (None, None) => Roughness::smooth(),
    }
}
