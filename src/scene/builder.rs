//! [`SceneBuilder`]: scenes without a file.

use std::any::Any;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Instant;

use super::{Emission, FilmSettings, IntegratorSettings, SamplerSettings, Scene, Shape};
use crate::accel::Accel;
use crate::bxdf::LambertianReflection;
use crate::camera::{Camera, CameraError, CameraSettings};
use crate::film::{Display, Filter, FilterError, FilterSampler, Window};
use crate::light::{AreaLight, KnownLight, Light};
use crate::material::{Material, MatteMaterial};
use crate::shape::{MeshError, TriangleMesh};
use crate::spectrum::Spectrum;

/// Why a scene cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// The camera cannot be built.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The part of the image to render is empty or sticks out.
    #[error(
        "the film's crop {corners:?} is empty or reaches beyond its resolution of {1} x {2}",
        corners = [.0.min, .0.max].map(|corner| corner.to_array()).as_flattened()
    )]
    Crop(Window, u32, u32),
    /// The filter covers nothing, or too much.
    #[error(transparent)]
    Filter(#[from] FilterError),
    /// There is nothing to average.
    #[error("the sampler's spp is 0: it has to be at least 1")]
    NoSamples,
    /// A shape is made of nothing that the scene knows.
    #[error("shape {shape:?} wants material {material:?}, which the scene does not have")]
    UnknownMaterial {
        /// The shape's name.
        shape: String,
        /// The name it asks for.
        material: String,
    },
    /// More triangles than [`Accel::MOST_TRIANGLES`].
    #[error("the scene has {0} triangles, more than {max}", max = Accel::MOST_TRIANGLES)]
    TooManyTriangles(usize),
    /// A mesh is broken.
    #[error("shape {0:?}: {1}")]
    Mesh(String, MeshError),
}

/// A shape as it was added.
struct NewShape {
    name: String,
    mesh: TriangleMesh,
    material: Option<String>,
    emission: Option<Emission>,
}

/// A material, with its lobe if it has one and the same everywhere.
type NewMaterial = (Arc<dyn Material>, Option<LambertianReflection>);

/// Collects a scene part by part, in any order, and checks it as a whole at the end.
#[derive(Default)]
pub struct SceneBuilder {
    camera: CameraSettings,
    film: FilmSettings,
    sampler: SamplerSettings,
    integrator: IntegratorSettings,
    materials: BTreeMap<String, NewMaterial>,
    shapes: Vec<NewShape>,
    lights: Vec<Arc<dyn Light>>,
    known_lights: Vec<Option<KnownLight>>,
}

impl SceneBuilder {
    /// Places the camera.
    pub fn camera(self, camera: CameraSettings) -> Self {
        Self { camera, ..self }
    }

    /// Sets all of the film.
    pub fn film(self, film: FilmSettings) -> Self {
        Self { film, ..self }
    }

    /// Sets the size of the image: columns and rows.
    pub fn resolution(self, width: u32, height: u32) -> Self {
        let film = FilmSettings { resolution: (width, height).into(), ..self.film };
        self.film(film)
    }

    /// Renders only a part of the image.
    pub fn crop(self, window: Window) -> Self {
        let film = FilmSettings { crop: Some(window), ..self.film };
        self.film(film)
    }

    /// Sets the reconstruction filter.
    pub fn filter(self, filter: Filter) -> Self {
        let film = FilmSettings { filter, ..self.film };
        self.film(film)
    }

    /// Sets the curve for PNG files.
    pub fn display(self, display: Display) -> Self {
        let film = FilmSettings { display, ..self.film };
        self.film(film)
    }

    /// Chooses the samples.
    pub fn sampler(self, sampler: SamplerSettings) -> Self {
        Self { sampler, ..self }
    }

    /// Chooses how light is computed.
    pub fn integrator(self, integrator: IntegratorSettings) -> Self {
        Self { integrator, ..self }
    }

    /// Adds a material; one of the same name is replaced.
    pub fn material(mut self, name: impl Into<String>, material: impl Material + 'static) -> Self {
        let matte = (&material as &dyn Any).downcast_ref::<MatteMaterial>();
        let plain = matte.and_then(MatteMaterial::plain);
        self.materials.insert(name.into(), (Arc::new(material), plain));
        self
    }

    /// Adds a material that may be held elsewhere too.
    pub fn shared_material(mut self, name: impl Into<String>, material: Arc<dyn Material>) -> Self {
        self.materials.insert(name.into(), (material, None));
        self
    }

    /// Adds a mesh in world space, made of the material of that name.
    pub fn shape(
        self,
        name: impl Into<String>,
        mesh: TriangleMesh,
        material: impl Into<String>,
    ) -> Self {
        self.add_shape(name.into(), mesh, Some(material.into()), None)
    }

    /// Adds a mesh in world space that sends out light, and reflects none.
    pub fn lamp(self, name: impl Into<String>, mesh: TriangleMesh, emission: Emission) -> Self {
        self.add_shape(name.into(), mesh, None, Some(emission))
    }

    /// Adds a mesh in world space that sends out light, and reflects what the material of that name does.
    pub fn glowing_shape(
        self,
        name: impl Into<String>,
        mesh: TriangleMesh,
        material: impl Into<String>,
        emission: Emission,
    ) -> Self {
        self.add_shape(name.into(), mesh, Some(material.into()), Some(emission))
    }

    pub(crate) fn add_shape(
        mut self,
        name: String,
        mesh: TriangleMesh,
        material: Option<String>,
        emission: Option<Emission>,
    ) -> Self {
        self.shapes.push(NewShape { name, mesh, material, emission });
        self
    }

    /// Adds a light.
    pub fn light(mut self, light: impl Light + 'static) -> Self {
        self.known_lights.push(KnownLight::new(&light));
        self.lights.push(Arc::new(light));
        self
    }

    /// Adds a light that may be held elsewhere too.
    pub fn shared_light(mut self, light: Arc<dyn Light>) -> Self {
        self.known_lights.push(None);
        self.lights.push(light);
        self
    }

    /// Checks camera, film and sampler, which can be done before there are meshes.
    pub fn check(&self) -> Result<(), SceneError> {
        self.checked_camera().map(drop)
    }

    fn checked_camera(&self) -> Result<Camera, SceneError> {
        let FilmSettings { resolution, .. } = self.film;
        let camera = Camera::new(&self.camera, resolution)?;
        let window = self.film.window();
        if window.min.cmpge(window.max).any() || window.max.cmpgt(resolution).any() {
            return Err(SceneError::Crop(window, resolution.x, resolution.y));
        }
        self.film.filter.check()?;
        if self.sampler.spp == 0 {
            return Err(SceneError::NoSamples);
        }
        Ok(camera)
    }

    /// Checks the scene and builds its tree.
    ///
    /// # Errors
    /// The first setting, mesh or name that is wrong.
    pub fn build(self) -> Result<Scene, SceneError> {
        let camera = self.checked_camera()?;
        let mut shapes = Vec::with_capacity(self.shapes.len());
        let mut meshes = Vec::with_capacity(self.shapes.len());
        let (mut lights, mut known_lights) = (self.lights, self.known_lights);
        for NewShape { name, mesh, material, emission } in self.shapes {
            mesh.check().map_err(|error| SceneError::Mesh(name.clone(), error))?;
            let (material, lobe) = match material {
                Some(material) => match self.materials.get(&material) {
                    Some(found) => found.clone(),
                    None => return Err(SceneError::UnknownMaterial { shape: name, material }),
                },
                None => (Arc::new(MatteMaterial::new(Spectrum::BLACK)) as _, None),
            };
            let plain = lobe.filter(|_| mesh.normals.is_empty());
            // A mesh without area can neither be seen nor shine.
            let light = emission
                .and_then(|Emission { radiance, two_sided }| {
                    AreaLight::new(&mesh, radiance, two_sided)
                })
                .map(|light| {
                    known_lights.push(KnownLight::new(&light));
                    lights.push(Arc::new(light));
                    lights.len() - 1
                });
            shapes.push(Shape { name, material, light, plain });
            meshes.push(mesh);
        }
        let triangles = meshes.iter().map(|mesh| mesh.indices.len()).sum();
        if triangles > Accel::MOST_TRIANGLES {
            return Err(SceneError::TooManyTriangles(triangles));
        }
        let is_plain = shapes.iter().all(|shape| shape.plain.is_some());
        let start = Instant::now();
        let accel = Accel::build(&meshes);
        Ok(Scene {
            camera,
            camera_settings: self.camera,
            film: self.film,
            sampler: self.sampler,
            integrator: self.integrator,
            shapes,
            meshes,
            filter: FilterSampler::new(self.film.filter)?,
            lights,
            known_lights,
            is_plain,
            accel,
            build_seconds: start.elapsed().as_secs_f64(),
        })
    }
}
