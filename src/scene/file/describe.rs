//! From the tree of a scene file to its [`Description`].

use glam::{Affine3A, Quat, UVec2, Vec3};

use super::description::{
    Description, LightDescription, MaterialDescription, ShapeDescription, ShapeSource, Source,
    TextureDescription,
};
use super::document::{Document, Fault};
use super::section::Section;
use super::value::{Direction, Light, Rotation, Scale};
use crate::camera::PerspectiveSettings;
use crate::film::Filter;
use crate::image::{Display, Window};
use crate::scene::{
    Emission, FilmSettings, IntegratorSettings, LightStrategy, SamplerKind, SamplerSettings,
};

/// Reflects half of the light, as matte does in PBRT if nothing is said.
const KD: Source = Source::Value(TextureDescription::ConstantColor([0.5; 3]));

/// How often light is reflected if nothing is said, as in PBRT.
const MAX_DEPTH: u32 = 5;

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

fn camera(section: &Section) -> Result<PerspectiveSettings, Fault> {
    section.only(&["eye", "look_at", "up", "fov", "lens_radius", "focal_distance"])?;
    let default = PerspectiveSettings::default();
    Ok(PerspectiveSettings {
        eye: section.get_or("eye", default.eye)?,
        look_at: section.get_or("look_at", default.look_at)?,
        up: section.get_or("up", default.up)?,
        handedness: default.handedness,
        fov: section.get_or("fov", default.fov)?,
        lens_radius: section.get_or("lens_radius", default.lens_radius)?,
        focal_distance: section.get_or("focal_distance", default.focal_distance)?,
    })
}

const FILM_KEYS: [&str; 6] =
    ["resolution", "crop", "display", "filter", "filter_radius", "filter_sigma"];

fn film(section: &Section) -> Result<FilmSettings, Fault> {
    section.only(&FILM_KEYS)?;
    let default = FilmSettings::default();
    let displays = [("srgb", Display::Srgb), ("exposure", Display::Exposure)];
    let window =
        |[x0, y0, x1, y1]: [u32; 4]| Window { min: UVec2::new(x0, y0), max: UVec2::new(x1, y1) };
    Ok(FilmSettings {
        resolution: section.get_or("resolution", default.resolution)?,
        crop: section.get("crop")?.map(window),
        display: section.choice("display", &displays)?.unwrap_or(default.display),
        filter: filter(section)?,
    })
}

fn filter(section: &Section) -> Result<Filter, Fault> {
    let filters = [
        ("box", Filter::Box),
        ("tent", Filter::tent()),
        ("gaussian", Filter::gaussian()),
        ("blackman-harris", Filter::blackman_harris()),
    ];
    let filter = section.choice("filter", &filters)?.unwrap_or_default();
    // The more of a shape a filter has, the more keys.
    let keys = match filter {
        Filter::Box => 4,
        Filter::Tent { .. } | Filter::BlackmanHarris { .. } => 5,
        Filter::Gaussian { .. } => 6,
    };
    section.only(&FILM_KEYS[..keys])?;
    let radius = |default| section.get_or("filter_radius", default);
    Ok(match filter {
        Filter::Box => Filter::Box,
        Filter::Tent { radius: r } => Filter::Tent { radius: radius(r)? },
        Filter::BlackmanHarris { radius: r } => Filter::BlackmanHarris { radius: radius(r)? },
        Filter::Gaussian { radius: r, sigma } => {
            Filter::Gaussian { radius: radius(r)?, sigma: section.get_or("filter_sigma", sigma)? }
        }
    })
}

fn sampler(section: &Section) -> Result<SamplerSettings, Fault> {
    section.only(&["type", "spp", "seed", "replicates"])?;
    let default = SamplerSettings::default();
    let kinds = [
        ("independent", SamplerKind::Independent),
        ("stratified", SamplerKind::Stratified),
        ("sobol", SamplerKind::Sobol),
        ("blue-noise", SamplerKind::BlueNoise),
    ];
    Ok(SamplerSettings {
        kind: section.choice("type", &kinds)?.unwrap_or(default.kind),
        spp: section.get_or("spp", default.spp)?,
        seed: section.get_or("seed", default.seed)?,
        replicates: section.get_or("replicates", default.replicates)?,
    })
}

fn integrator(section: &Section) -> Result<IntegratorSettings, Fault> {
    let chapter = IntegratorSettings::Chapter { highlight: false };
    let kinds = [
        ("chapter", chapter),
        ("direct", IntegratorSettings::direct()),
        ("path", IntegratorSettings::path(MAX_DEPTH)),
    ];
    match section.choice("type", &kinds)?.unwrap_or_default() {
        IntegratorSettings::Chapter { highlight } => {
            section.only(&["type", "highlight"])?;
            let highlight = section.get_or("highlight", highlight)?;
            Ok(IntegratorSettings::Chapter { highlight })
        }
        IntegratorSettings::Direct { .. } => {
            section.only(&["type", "strategy"])?;
            Ok(IntegratorSettings::Direct { strategy: strategy(section)? })
        }
        IntegratorSettings::Path { max_depth, roulette, .. } => {
            section.only(&["type", "max_depth", "roulette", "strategy"])?;
            Ok(IntegratorSettings::Path {
                max_depth: section.get_or("max_depth", max_depth)?,
                roulette: section.get_or("roulette", roulette)?,
                strategy: strategy(section)?,
            })
        }
    }
}

fn strategy(section: &Section) -> Result<LightStrategy, Fault> {
    let strategies = [
        ("auto", LightStrategy::Auto),
        ("mis", LightStrategy::Mis),
        ("light", LightStrategy::Light),
        ("bsdf", LightStrategy::Bsdf),
    ];
    Ok(section.choice("strategy", &strategies)?.unwrap_or_default())
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
    #[derive(Clone, Copy)]
    enum Kind {
        Point,
        Distant,
        Sky,
    }
    let kinds = [("point", Kind::Point), ("distant", Kind::Distant), ("sky", Kind::Sky)];
    match section.require_choice("type", &kinds)? {
        Kind::Point => {
            section.only(&["type", "position", "intensity"])?;
            let Light(intensity) = section.require("intensity")?;
            Ok(LightDescription::Point { position: section.require("position")?, intensity })
        }
        Kind::Distant => {
            section.only(&["type", "direction", "irradiance"])?;
            let Light(irradiance) = section.require("irradiance")?;
            let Direction(direction) = section.require("direction")?;
            Ok(LightDescription::Distant { direction, irradiance })
        }
        Kind::Sky => {
            section.only(&["type", "radiance"])?;
            let Light(radiance) = section.require("radiance")?;
            Ok(LightDescription::Sky { radiance })
        }
    }
}

fn shape(section: &Section, document: &Document) -> Result<ShapeDescription, Fault> {
    let kind = section.choice("type", &[("obj", false), ("rectangle", true)])?;
    let is_rectangle = kind.unwrap_or(false);
    let radiance: Option<Light> = section.get("emission")?;
    let own: &[&str] = if is_rectangle { &["corner", "edges"] } else { &["obj"] };
    let of_light: &[&str] = if radiance.is_some() { &["two_sided"] } else { &[] };
    let common = ["material", "scale", "rotate", "translate", "type", "emission"];
    section.only(&[own, &common, of_light].concat())?;
    let Scale(scale) = section.get_or("scale", Scale(Vec3::ONE))?;
    let Rotation(rotation) = section.get_or("rotate", Rotation(Quat::IDENTITY))?;
    let translation = section.get_or("translate", Vec3::ZERO)?;
    let two_sided = section.get_or("two_sided", false)?;
    let source = if is_rectangle {
        let corner = section.require("corner")?;
        ShapeSource::Rectangle { corner, edges: section.require("edges")? }
    } else {
        let obj: String = section.require("obj")?;
        ShapeSource::Obj(document.resolve(section.mark("obj"), &obj))
    };
    let emission = radiance.map(|Light(rgb)| Emission { radiance: rgb.into(), two_sided });
    let material = match emission {
        Some(_) => section.get("material")?,
        None => Some(section.require("material")?),
    };
    Ok(ShapeDescription {
        source,
        material,
        emission,
        // Scaled first, moved last.
        transform: Affine3A::from_scale_rotation_translation(scale, rotation, translation),
    })
}
