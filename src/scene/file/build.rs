//! From a [`Description`] to a scene.

use super::description::{
    Description, LightDescription, MaterialDescription, ShapeDescription, ShapeSource, Source,
    TextureDescription,
};
use super::document::{Document, Fault};
use super::error::Problem;
use super::hint::hint;
use super::section::full_name;
use crate::camera::CameraError;
use crate::film::FilterError;
use crate::light::{DistantLight, PointLight, SkyLight};
use crate::material::MatteMaterial;
use crate::scene::{RenderSettings, Scene, SceneBuilder, SceneError, View, ViewError};
use crate::shape::{ObjMesh, ObjReport, TriangleMesh, read_obj};

/// Looks up all names, reads the meshes and builds the scene, its view and its settings. The last two are checked
/// before the meshes are read, which may take long.
pub fn build(
    description: Description,
    document: &Document,
) -> Result<(Scene, View, RenderSettings, Vec<ObjReport>), Fault> {
    let Description { camera, film, sampler, integrator, textures, materials, lights, shapes } =
        description;
    let mut builder = Scene::builder();
    for (name, material) in &materials {
        let textures = Textures { textures: &textures, document, material: name };
        builder = builder.material(name, textures.material(material)?);
    }
    for light in lights {
        builder = match light {
            LightDescription::Point { position, intensity } => {
                builder.light(PointLight::new(position, intensity.into()))
            }
            // A light knows where it shines from, a file says where to.
            LightDescription::Distant { direction, irradiance } => {
                // There is one for every direction, which what was read is.
                let light = DistantLight::new(-direction, irradiance.into());
                light.into_iter().fold(builder, SceneBuilder::light)
            }
            LightDescription::Sky { radiance } => builder.light(SkyLight::new(radiance.into())),
        };
    }
    let view = View::perspective(&camera, film)
        .map_err(|error| document.fault(&keys_of_view(&error), error))?;
    sampler.check().map_err(|error| document.fault(&["sampler", "spp"], error))?;
    for (name, shape) in &shapes {
        let Some(material) = &shape.material else { continue };
        if materials.iter().all(|(known, _)| known != material) {
            let known = materials.iter().map(|(known, _)| known.as_str());
            let problem = unknown("material", material, known);
            return Err(document.fault(&["shape", name, "material"], problem));
        }
    }
    let mut reports = Vec::with_capacity(shapes.len());
    for (name, ShapeDescription { source, material, emission, transform }) in shapes {
        let mut mesh = match source {
            ShapeSource::Obj(obj) => {
                let ObjMesh { mesh, report } = read_obj(&obj)
                    .map_err(|error| document.fault(&["shape", &name, "obj"], error))?;
                reports.push(report);
                mesh
            }
            ShapeSource::Rectangle { corner, edges: [u, v] } => {
                reports.push(ObjReport::default());
                TriangleMesh::parallelogram(corner, u, v)
            }
        };
        mesh.transform(&transform);
        builder = builder.add_shape(name, mesh, material, emission);
    }
    let fault = |error: SceneError| {
        let mark = document.root.follow(&keys(&error)).mark;
        Fault { mark, problem: error.into() }
    };
    let scene = builder.build().map_err(fault)?;
    Ok((scene, view, RenderSettings { sampler, integrator }, reports))
}

/// The key whose value an error is about.
fn keys(error: &SceneError) -> Vec<&str> {
    match error {
        SceneError::UnknownMaterial { shape, .. } => vec!["shape", shape, "material"],
        SceneError::TooManyTriangles(_) => vec!["shape"],
        SceneError::Mesh(shape, _) => vec!["shape", shape],
    }
}

/// The key whose value an error is about.
fn keys_of_view(error: &ViewError) -> Vec<&'static str> {
    match error {
        ViewError::Camera(error) => match error {
            CameraError::OutOfRange(key) => vec!["camera", key],
            CameraError::NoDirection => vec!["camera", "look_at"],
            CameraError::NoUp => vec!["camera", "up"],
            CameraError::Fov(_) => vec!["camera", "fov"],
            CameraError::Extent(_) => vec!["camera", "extent"],
            CameraError::LensRadius(_) => vec!["camera", "lens_radius"],
            CameraError::FocalDistance(_) => vec!["camera", "focal_distance"],
            CameraError::Resolution(..) => vec!["film", "resolution"],
        },
        ViewError::Resolution { .. } => vec!["film", "resolution"],
        ViewError::Crop(..) => vec!["film", "crop"],
        ViewError::Filter(FilterError::Radius(_)) => vec!["film", "filter_radius"],
        ViewError::Filter(FilterError::Sigma(_)) => vec!["film", "filter_sigma"],
    }
}

fn unknown<'a>(kind: &str, name: &str, known: impl Iterator<Item = &'a str>) -> Problem {
    let hint = hint(name, known);
    Problem::UnknownName { kind: kind.into(), name: name.escape_debug().to_string(), hint }
}

/// The scene's textures, for one of its materials.
struct Textures<'a> {
    textures: &'a [(String, TextureDescription)],
    document: &'a Document<'a>,
    material: &'a str,
}

impl Textures<'_> {
    fn material(&self, material: &MaterialDescription) -> Result<MatteMaterial, Fault> {
        let MaterialDescription::Matte { kd, sigma, bump } = material;
        let color = |texture| match texture {
            TextureDescription::ConstantColor(c) if c.iter().all(|c| (0.0..=1.0).contains(c)) => {
                Some(c)
            }
            _ => None,
        };
        let number = |texture| match texture {
            TextureDescription::ConstantNumber(x) => Some(x),
            TextureDescription::ConstantColor(_) => None,
        };
        let angle = |texture| number(texture).filter(|angle| (0.0..=90.0).contains(angle));

        let kd = self.value("kd", kd, color, "[red, green, blue], each from 0 to 1")?;
        let mut matte = MatteMaterial::new(kd);
        if let Some(sigma) = sigma {
            matte = matte.with_sigma(self.value("sigma", sigma, angle, "degrees from 0 to 90")?);
        }
        if let Some(bump) = bump {
            matte = matte.with_bump(self.value("bump", bump, number, "a number")?);
        }
        Ok(matte)
    }

    /// The value of a texture, or the one in its place, if `accept` finds it fit for the key.
    fn value<T>(
        &self,
        key: &str,
        source: &Source,
        accept: impl Fn(TextureDescription) -> Option<T>,
        expected: &str,
    ) -> Result<T, Fault> {
        let fault = |problem| self.document.fault(&["material", self.material, key], problem);
        let (texture, found) = match source {
            Source::Value(value) => (value, value.to_string()),
            Source::Texture(name) => {
                let entry = self.textures.iter().find(|(known, _)| known == name);
                let known = self.textures.iter().map(|(known, _)| known.as_str());
                let (_, texture) = entry.ok_or_else(|| fault(unknown("texture", name, known)))?;
                (texture, format!("the texture {name:?}, {texture}"))
            }
        };
        let key = full_name(&full_name("material", self.material), key);
        let problem = || Problem::Value { key, found, expected: expected.into() };
        accept(*texture).ok_or_else(|| fault(problem()))
    }
}
