//! Materials of MTL files, as this crate's kinds.
//!
//! | what MTL says | material |
//! |---|---|
//! | `Pm` above 1/2 | metal that reflects `Kd` at the normal, white without it; by `map_Pm`, between that and what the other rows say |
//! | `illum` 4, 6, 7 or 9 | glass of index `Ni`; refracted light is scaled by `Tf` |
//! | `illum` 3 or 5 with black `Kd`, and `Ks` | metal that reflects `Ks` |
//! | `Ks` above 0, with `illum` 2, 3, 5, 8 or none | plastic: a coat of index `Ni` over `Kd` |
//! | else | matte, `Kd` |
//!
//! The first row that fits holds. An index that is missing, at most 1 or above 10 is 1.5, and a missing `Kd` is 0.5. Roughness is `Pr`, perceptual, or α = √(2 / (Ns + 2)) from Phong's exponent `Ns` (Walter et al. 2007, section 5.2), else 0.
//! Where the opacity, `d` or 1 - `Tr`, is below 1 and there is no glass, the rest of the material is a thin pane, through which light goes straight:
//! of index `Ni` if there is `Ks`, else one that reflects nothing; what it lets through is scaled by `Tf`.
//! `map_Kd` is multiplied by `Kd`, unless that is black, and `map_Ke` by `Ke`; `map_Pr` and `map_Pm` by `Pr` and `Pm`, unless these are 0. `map_Bump` times `-bm` is a
//! displacement in scene units, `norm` are normals, and rays pass where `map_d` is 0.

use std::path::Path;
use std::sync::Arc;

use glam::Vec2;

use super::{
    DetailedMaterial, GlassMaterial, Material, MatteMaterial, MetalMaterial, MixMaterial,
    PlasticMaterial, Roughness, ThinGlassMaterial,
};
use crate::file;
use crate::image::ReadError;
use crate::interaction::SurfaceInteraction;
use crate::shape::{MtlMap, MtlMaterial, MtlNote};
use crate::spectrum::Spectrum;
use crate::texture::{
    Channel, Curve, ImageTexture, Mapping, ProductTexture, Texture, TextureHandle, Textures, Wrap,
};

/// Makes materials from those of an MTL file.
pub struct MtlMaterials<'a> {
    /// The folder of the file, to which names of images are relative.
    pub folder: &'a Path,
    /// The images that materials share.
    pub textures: &'a Textures,
}

impl MtlMaterials<'_> {
    /// The material, and what was left out of it.
    pub fn make(&self, mtl: &MtlMaterial) -> (Arc<dyn Material>, Vec<MtlNote>) {
        let mut notes = Vec::new();
        let has_glass = matches!(mtl.illum, Some(4 | 6 | 7 | 9));
        let ks = Spectrum::from(mtl.ks.unwrap_or_default());
        let eta = mtl.ni.filter(|ni| *ni > 1.0 && *ni <= 10.0).unwrap_or(1.5);
        let filter = Spectrum::from(mtl.tf.unwrap_or([1.0; 3]));
        // Without a map of it, metal is all or nothing.
        let metal = match self.number(mtl.pm, named("map_Pm", &mtl.map_pm), &mut notes) {
            Some(TextureHandle::Constant(pm)) => (pm > 0.5).then_some(TextureHandle::Constant(1.0)),
            map => map,
        };
        let is_metal = metal.as_ref().is_some_and(|metal| metal.constant().is_some());
        if let Some(MtlMap { line, .. }) = mtl.map_kd.as_ref().filter(|_| has_glass && !is_metal) {
            notes.push(MtlNote { line: *line, what: "map_Kd of glass is not used".into() });
        }
        // Glass has no place for it.
        let map = named("map_Kd", &mtl.map_kd).filter(|_| !has_glass || is_metal);
        let without = Spectrum::splat(if is_metal { 1.0 } else { 0.5 });
        let kd = self.color(mtl.kd, without, map, &mut notes);
        let rough = self.roughness(mtl, &mut notes);
        let metallic = |kd: &TextureHandle<Spectrum>| {
            MetalMaterial::reflecting(kd.clone()).with_roughness(rough.clone())
        };
        let material: Arc<dyn Material> = match mtl.illum {
            _ if is_metal => Arc::new(metallic(&kd)),
            _ if has_glass => {
                Arc::new(GlassMaterial::new(eta).with_kt(filter).with_roughness(rough.clone()))
            }
            Some(3 | 5) if kd.constant() == Some(Spectrum::BLACK) && !ks.is_black() => {
                Arc::new(metallic(&ks.into_handle()))
            }
            None | Some(2 | 3 | 5 | 8) if !ks.is_black() || metal.is_some() => {
                Arc::new(PlasticMaterial::new(kd.clone(), eta).with_roughness(rough.clone()))
            }
            _ => Arc::new(MatteMaterial::new(kd.clone())),
        };
        let material = match metal {
            Some(metal) if metal.constant().is_none() && !has_glass => {
                Arc::new(MixMaterial::new(material, metallic(&kd), metal))
            }
            _ => material,
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
        (self.detailed(material, mtl, &mut notes), notes)
    }

    /// The material with bumps, normals and holes.
    fn detailed(
        &self,
        material: Arc<dyn Material>,
        mtl: &MtlMaterial,
        notes: &mut Vec<MtlNote>,
    ) -> Arc<dyn Material> {
        let normals =
            named("norm", &mtl.norm).and_then(|map| self.found(map, Curve::Linear, notes));
        let bump = named("map_Bump", &mtl.map_bump).and_then(|map| self.numbers(map, notes));
        let opacity = named("map_d", &mtl.map_d).and_then(|map| self.numbers(map, notes));
        if normals.is_none() && bump.is_none() && opacity.is_none() {
            return material;
        }
        let mut detailed = DetailedMaterial::new(material);
        if let Some(normals) = normals {
            detailed = detailed.with_normals(normals);
        }
        if let (Some(heights), Some(map)) = (bump, &mtl.map_bump) {
            detailed = detailed.with_bump(ProductTexture::new(heights, map.bump));
        }
        if let Some(opacity) = opacity {
            detailed = detailed.with_opacity(opacity);
        }
        Arc::new(detailed)
    }

    /// The emitted radiance: `Ke` times `map_Ke`, and what was left out of it. Black is a constant.
    pub fn emission(&self, mtl: &MtlMaterial) -> (TextureHandle<Spectrum>, Vec<MtlNote>) {
        let mut notes = Vec::new();
        let ke = mtl.ke.map(Spectrum::from);
        let alone = ke.unwrap_or_default();
        let Some(map) = &mtl.map_ke else { return (alone.into_handle(), notes) };
        if ke == Some(Spectrum::BLACK) {
            let what = "map_Ke times a black Ke emits nothing".into();
            notes.push(MtlNote { line: map.line, what });
            return (alone.into_handle(), notes);
        }
        let emission = match self.found(("map_Ke", map), Curve::Srgb, &mut notes) {
            None => alone.into_handle(),
            Some(image) if image.is_black() && map.base_gain[0] <= 0.0 => {
                Spectrum::BLACK.into_handle()
            }
            Some(image) => scaled(with_base_and_gain(image, map), ke),
        };
        (emission, notes)
    }

    fn roughness(&self, mtl: &MtlMaterial, notes: &mut Vec<MtlNote>) -> Roughness {
        match (self.number(mtl.pr, named("map_Pr", &mtl.map_pr), notes), mtl.ns) {
            (Some(pr), _) => Roughness::perceptual(pr),
            (None, Some(ns)) => Roughness::alpha((2.0 / (ns.max(0.0) + 2.0)).sqrt()),
            (None, None) => Roughness::smooth(),
        }
    }

    /// A number, an image, or their product.
    fn number(
        &self,
        number: Option<f32>,
        map: Option<Map>,
        notes: &mut Vec<MtlNote>,
    ) -> Option<TextureHandle<f32>> {
        let image = map.and_then(|map| self.numbers(map, notes));
        match (image, number.filter(|number| *number != 0.0 && *number != 1.0)) {
            (Some(image), Some(number)) => Some(ProductTexture::new(image, number).into_handle()),
            (Some(image), None) => Some(image),
            (None, _) => number.map(|number| number.clamp(0.0, 1.0).into_handle()),
        }
    }

    /// An image of numbers. Without a channel it is the luminance.
    fn numbers(&self, (key, map): Map, notes: &mut Vec<MtlNote>) -> Option<TextureHandle<f32>> {
        let channel = match map.channel {
            Some('r') => Channel::Red,
            Some('g') => Channel::Green,
            Some('b') => Channel::Blue,
            _ => Channel::Luminance,
        };
        let numbers = self.found((key, map), Curve::Linear, notes)?.channel(channel);
        let [base, gain] = map.base_gain;
        Some(if [base, gain] == [0.0, 1.0] {
            numbers.into_handle()
        } else {
            (move |si: &SurfaceInteraction| base + numbers.evaluate(si) * gain).into_handle()
        })
    }

    /// The image of a key, or a note.
    fn found(
        &self,
        (key, map): Map,
        curve: Curve,
        notes: &mut Vec<MtlNote>,
    ) -> Option<ImageTexture> {
        let note = |error| MtlNote { line: map.line, what: format!("{key}: {error}") };
        self.image(map, curve).map_err(|error| notes.push(note(error))).ok()
    }

    /// A colour, an image, or their product.
    fn color(
        &self,
        color: Option<[f32; 3]>,
        without: Spectrum,
        map: Option<Map>,
        notes: &mut Vec<MtlNote>,
    ) -> TextureHandle<Spectrum> {
        let given = color.map(Spectrum::from);
        let color = given.unwrap_or(without);
        let Some((key, map)) = map else { return color.into_handle() };
        match self.found((key, map), Curve::Srgb, notes) {
            None => color.into_handle(),
            Some(image) => {
                scaled(with_base_and_gain(image, map), given.filter(|color| !color.is_black()))
            }
        }
    }

    fn image(&self, map: &MtlMap, curve: Curve) -> Result<ImageTexture, Arc<ReadError>> {
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

/// A map with its key.
type Map<'m> = (&'static str, &'m MtlMap);

fn named<'m>(key: &'static str, map: &'m Option<MtlMap>) -> Option<Map<'m>> {
    map.as_ref().map(|map| (key, map))
}

/// Colours of an image after `-mm`.
fn with_base_and_gain(image: ImageTexture, map: &MtlMap) -> TextureHandle<Spectrum> {
    let [base, gain] = map.base_gain;
    if [base, gain] == [0.0, 1.0] {
        return image.into_handle();
    }
    (move |si: &SurfaceInteraction| Spectrum::splat(base) + image.evaluate(si) * gain).into_handle()
}

/// The texture times a colour, if there is one that changes it.
fn scaled(texture: TextureHandle<Spectrum>, color: Option<Spectrum>) -> TextureHandle<Spectrum> {
    match color.filter(|color| *color != Spectrum::WHITE) {
        Some(color) => ProductTexture::new(texture, color).into_handle(),
        None => texture,
    }
}

/// `d`, or 1 - `Tr`.
fn opacity(mtl: &MtlMaterial) -> f32 {
    mtl.d.or(mtl.tr.map(|tr| 1.0 - tr)).unwrap_or(1.0).clamp(0.0, 1.0)
}
