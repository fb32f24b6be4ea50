//! The tables of a scene file: the registry that reads each, and the keys that all of its kinds share.

use glam::{UVec2, Vec3};

use crate::camera::{self, CAMERAS};
use crate::film::{FILTERS, ReadFilter};
use crate::image::Display;
use crate::integrator::{self, INTEGRATORS};
use crate::light::{self, LIGHTS};
use crate::material::{self, DETAILS, MATERIALS};
use crate::params::{AnySection, Fault, Key, Kind, Mark, Rotation, Scale, Section, Table};
use crate::render::SamplerSettings;
use crate::sampling::{Make, SAMPLERS};
use crate::scene::FilmSettings;
use crate::shape::{self, SHAPES};
use crate::spectrum::Spectrum;
use crate::texture::{self, TEXTURES, TextureKey};

/// All tables, in the order of the documentation.
pub static SECTIONS: [&dyn AnySection; 9] =
    [&CAMERA, &FILM, &SAMPLER, &INTEGRATOR, &TEXTURE, &MATERIAL, &LIGHT, &SHAPE, &INSTANCE];

pub static CAMERA: Section<camera::Read> = Section {
    key: "camera",
    plural: "cameras",
    is_named: false,
    selector: "type",
    default: Some(CAMERAS[0].name),
    common: &[],
    kinds: CAMERAS,
};

pub const RESOLUTION: Key<UVec2> = Key::new("resolution", "columns and rows of the image")
    .at_least(1.0)
    .default(FilmSettings::DEFAULT_RESOLUTION);
pub const CROP: Key<Option<[u32; 4]>> = Key::optional(
    "crop",
    "the part to render, [x0, y0, x1, y1] without column x1 and row y1; all of the image if left out",
);
pub const DISPLAY: Key<Display> =
    Key::new("display", "the curve of a PNG: sRGB's, or 1 - exp(-4 L)")
        .default(FilmSettings::DEFAULT_DISPLAY);

pub static FILM: Section<ReadFilter> = Section {
    key: "film",
    plural: "filters",
    is_named: false,
    selector: "filter",
    default: Some(FILTERS[0].name),
    common: &[&RESOLUTION, &CROP, &DISPLAY],
    kinds: FILTERS,
};

pub const SPP: Key<u32> =
    Key::new("spp", "samples per pixel").at_least(1.0).default(SamplerSettings::DEFAULT.spp);
pub const SEED: Key<u64> =
    Key::new("seed", "seed of the random numbers").default(SamplerSettings::DEFAULT.seed);
pub const REPLICATES: Key<u32> = Key::new(
    "replicates",
    "independent sets of samples, from which the error is estimated; for all samplers but \"independent\". At most \
     spp",
)
.at_least(1.0)
.at_most(SamplerSettings::MAX_SETS as f64)
.default(SamplerSettings::DEFAULT.replicates);

pub static SAMPLER: Section<Make> = Section {
    key: "sampler",
    plural: "samplers",
    is_named: false,
    selector: "type",
    default: Some(SamplerSettings::DEFAULT.kind.name()),
    common: &[&SPP, &SEED, &REPLICATES],
    kinds: SAMPLERS,
};

pub static INTEGRATOR: Section<integrator::Read> = Section {
    key: "integrator",
    plural: "integrators",
    is_named: false,
    selector: "type",
    default: Some(INTEGRATORS[0].name),
    common: &[],
    kinds: INTEGRATORS,
};

pub static TEXTURE: Section<texture::Read> = Section {
    key: "texture",
    plural: "textures",
    is_named: true,
    selector: "type",
    default: None,
    common: &[],
    kinds: TEXTURES,
};

pub static MATERIAL: Section<material::Read> = Section {
    key: "material",
    plural: "materials",
    is_named: true,
    selector: "type",
    default: None,
    common: DETAILS,
    kinds: MATERIALS,
};

pub static LIGHT: Section<light::Read> = Section {
    key: "light",
    plural: "lights",
    is_named: true,
    selector: "type",
    default: None,
    common: &[],
    kinds: LIGHTS,
};

pub const SHAPE_MATERIAL: Key<Option<String>> = Key::optional(
    MATERIAL.key,
    "name of the material; required but for shapes with emission, which reflect nothing without one, and for OBJ files whose faces name \
     materials: of the scene, else of MTL files, else grey",
);
pub const EMISSION: TextureKey<Option<Spectrum>> = TextureKey::of(
    Key::optional("emission", "emitted radiance, in W / (m² sr); a texture is not filtered")
        .at_least(0.0),
);
pub const TWO_SIDED: Key<Option<bool>> = Key::optional(
    "two_sided",
    "whether both sides emit, or only the outer one; if left out, lamps of MTL files emit on both, and others on one",
);
pub const SCALE: Key<Scale> =
    Key::new("scale", "one factor, or factors along x, y and z").default(Scale(Vec3::ONE));
pub const ROTATE: Key<Option<Rotation>> =
    Key::optional("rotate", "about an axis through the origin; about +z from x to y");
pub const TRANSLATE: Key<Vec3> = Key::new("translate", "in scene units").default(Vec3::ZERO);

pub static SHAPE: Section<shape::Read> = Section {
    key: "shape",
    plural: "shapes",
    is_named: true,
    selector: "type",
    default: Some(SHAPES[0].name),
    common: &[&SHAPE_MATERIAL, &EMISSION, &TWO_SIDED, &SCALE, &ROTATE, &TRANSLATE],
    kinds: SHAPES,
};

const OF: Key<String> = Key::new(SHAPE.key, "name of the shape, which stays where it is");

/// How a kind of instance is read: the shape's name and its place.
pub type ReadInstance = fn(&Table) -> Result<(String, Mark), Fault>;

pub static INSTANCE: Section<ReadInstance> = Section {
    key: "instance",
    plural: "instances",
    is_named: true,
    selector: "type",
    default: Some("shape"),
    common: &[&SCALE, &ROTATE, &TRANSLATE],
    kinds: &[Kind {
        name: "shape",
        meaning: "A shape once more, moved from where it stands, without a copy of its mesh",
        keys: &[&OF],
        read: |table| Ok((table.get(&OF)?, table.mark(&OF))),
    }],
};
