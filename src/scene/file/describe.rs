//! From the tree of a scene file to its [`Description`].

use glam::{Affine3A, Quat, UVec2, Vec3};

use super::description::{
    Description, LightDescription, MaterialDescription, ShapeDescription, Source,
    TextureDescription,
};
use super::document::{Document, Fault};
use super::section::Section;
use super::value::{Intensity, Rotation, Scale};
use crate::camera::CameraSettings;
use crate::film::{Display, Window};
use crate::scene::{FilmSettings, IntegratorSettings, SamplerKind, SamplerSettings};

/// Reflects half of the light, as matte does in PBRT if nothing is said.
const KD: Source = Source::Value(TextureDescription::ConstantColor([0.5; 3]));

/// Reads all tables. Names are not looked up yet.
pub fn describe(document: &Document) -> Result<Description, Fault> {
    let root = Section::root(&document.root);
    root.only(&[
        "camera",
        "film",
        "sampler",
        "integrator",
        "texture",
        "material",
        "light",
        "shape",
    ])?;
    Ok(Description {
        camera: one(&root, "camera", camera)?,
        film: one(&root, "film", film)?,
        sampler: one(&root, "sampler", sampler)?,
        integrator: one(&root, "integrator", integrator)?,
        textures: all(&root, "texture", texture)?,
        materials: all(&root, "material", material)?,
        lights: all(&root, "light", light)?.into_iter().map(|(_, light)| light).collect(),
        shapes: all(&root, "shape", |section| shape(section, document))?,
    })
}

/// A table that there is once, or its default.
fn one<T: Default>(
    root: &Section,
    key: &str,
    read: impl Fn(&Section) -> Result<T, Fault>,
) -> Result<T, Fault> {
    root.section(key)?.map_or(Ok(T::default()), |section| read(&section))
}

/// All tables of a kind, with their names.
fn all<T>(
    root: &Section,
    kind: &str,
    read: impl Fn(&Section) -> Result<T, Fault>,
) -> Result<Vec<(String, T)>, Fault> {
    let Some(section) = root.section(kind)? else { return Ok(Vec::new()) };
    let named = |entry: Result<(&str, Section), Fault>| {
        let (name, section) = entry?;
        Ok((name.to_owned(), read(&section)?))
    };
    section.sections().map(named).collect()
}

fn camera(section: &Section) -> Result<CameraSettings, Fault> {
    section.only(&["eye", "look_at", "up", "fov", "lens_radius", "focal_distance"])?;
    let default = CameraSettings::default();
    Ok(CameraSettings {
        eye: section.get_or("eye", default.eye)?,
        look_at: section.get_or("look_at", default.look_at)?,
        up: section.get_or("up", default.up)?,
        fov: section.get_or("fov", default.fov)?,
        lens_radius: section.get_or("lens_radius", default.lens_radius)?,
        focal_distance: section.get_or("focal_distance", default.focal_distance)?,
    })
}

fn film(section: &Section) -> Result<FilmSettings, Fault> {
    section.only(&["resolution", "crop", "display"])?;
    let default = FilmSettings::default();
    let displays = [("srgb", Display::Srgb), ("exposure", Display::Exposure)];
    let window =
        |[x0, y0, x1, y1]: [u32; 4]| Window { min: UVec2::new(x0, y0), max: UVec2::new(x1, y1) };
    Ok(FilmSettings {
        resolution: section.get_or("resolution", default.resolution)?,
        crop: section.get("crop")?.map(window),
        display: section.choice("display", &displays)?.unwrap_or(default.display),
        filter: default.filter,
    })
}

fn sampler(section: &Section) -> Result<SamplerSettings, Fault> {
    section.only(&["type", "spp", "seed"])?;
    let default = SamplerSettings::default();
    let kinds =
        [("independent", SamplerKind::Independent), ("stratified", SamplerKind::Stratified)];
    Ok(SamplerSettings {
        kind: section.choice("type", &kinds)?.unwrap_or(default.kind),
        spp: section.get_or("spp", default.spp)?,
        seed: section.get_or("seed", default.seed)?,
        replicates: default.replicates,
    })
}

fn integrator(section: &Section) -> Result<IntegratorSettings, Fault> {
    let chapter = IntegratorSettings::Chapter { highlight: false };
    let kinds = [("chapter", chapter), ("direct", IntegratorSettings::direct())];
    match section.choice("type", &kinds)?.unwrap_or_default() {
        IntegratorSettings::Chapter { highlight } => {
            section.only(&["type", "highlight"])?;
            let highlight = section.get_or("highlight", highlight)?;
            Ok(IntegratorSettings::Chapter { highlight })
        }
        other => {
            section.only(&["type"])?;
            Ok(other)
        }
    }
}

fn texture(section: &Section) -> Result<TextureDescription, Fault> {
    section.require_choice("type", &[("constant", ())])?;
    section.only(&["type", "value"])?;
    section.require("value")
}

fn material(section: &Section) -> Result<MaterialDescription, Fault> {
    section.require_choice("type", &[("matte", ())])?;
    section.only(&["type", "kd", "sigma", "bump"])?;
    Ok(MaterialDescription::Matte {
        kd: section.get_or("kd", KD)?,
        sigma: section.get("sigma")?,
        bump: section.get("bump")?,
    })
}

fn light(section: &Section) -> Result<LightDescription, Fault> {
    section.require_choice("type", &[("point", ())])?;
    section.only(&["type", "position", "intensity"])?;
    let Intensity(intensity) = section.require("intensity")?;
    Ok(LightDescription::Point { position: section.require("position")?, intensity })
}

fn shape(section: &Section, document: &Document) -> Result<ShapeDescription, Fault> {
    section.only(&["obj", "material", "scale", "rotate", "translate"])?;
    let Scale(scale) = section.get_or("scale", Scale(Vec3::ONE))?;
    let Rotation(rotation) = section.get_or("rotate", Rotation(Quat::IDENTITY))?;
    let translation = section.get_or("translate", Vec3::ZERO)?;
    let obj: String = section.require("obj")?;
    Ok(ShapeDescription {
        obj: document.resolve(section.mark("obj"), &obj),
        material: section.require("material")?,
        // Scaled first, moved last.
        transform: Affine3A::from_scale_rotation_translation(scale, rotation, translation),
    })
}
