//! [`SceneBuilder`]: collects shapes, materials and lights, and builds a [`Scene`].

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;

use super::model::{Scene, Shape};
use super::settings::Emission;
use crate::accel::{Accel, InstructionSet};
use crate::clock::Stopwatch;
use crate::interaction::LastVertex;
use crate::light::{AreaLight, Light};
use crate::material::{Material, MatteMaterial};
use crate::params::quoted;
use crate::shape::{MeshError, TriangleMesh};
use crate::spectrum::Spectrum;

/// Why a scene cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// A shape refers to a material that the scene does not have.
    #[error(
        "shape {} refers to material {}, which the scene does not have",
        quoted(shape),
        quoted(material)
    )]
    UnknownMaterial {
        /// The shape's name.
        shape: String,
        /// The name of the missing material.
        material: String,
    },
    /// More triangles than [`Accel::MAX_TRIANGLES`].
    #[error("the scene has {0} triangles, more than {max}", max = Accel::MAX_TRIANGLES)]
    TooManyTriangles(usize),
    /// An [`Emission`] is negative or not finite.
    #[error(
        "shape {} emits {radiance:?}: each band has to be finite and at least 0",
        quoted(shape)
    )]
    Emission {
        /// The shape.
        shape: String,
        /// What it emits.
        radiance: [f32; 3],
    },
    /// A mesh failed [`TriangleMesh::check`].
    #[error("shape {}: {}", quoted(.0), .1)]
    Mesh(String, MeshError),
}

/// Emission of a shape, before `build`.
enum NewEmission {
    Constant(Emission),
    Light(Arc<dyn Light>),
}

/// A shape, before `build`.
struct NewShape {
    name: String,
    mesh: TriangleMesh,
    material: Option<String>,
    emission: Option<NewEmission>,
}

/// Collects the parts of a [`Scene`] in any order. [`build`](Self::build) checks them.
#[derive(Default)]
pub struct SceneBuilder {
    materials: BTreeMap<String, Arc<dyn Material>>,
    shapes: Vec<NewShape>,
    lights: Vec<Arc<dyn Light>>,
    instruction_set: InstructionSet,
}

impl Scene {
    /// An empty builder.
    pub fn builder() -> SceneBuilder {
        SceneBuilder::default()
    }
}

impl SceneBuilder {
    /// Adds a material, or replaces the one of that name. To share it, pass an [`Arc`].
    pub fn material(mut self, name: impl Into<String>, material: impl Material + 'static) -> Self {
        self.materials.insert(name.into(), material.into_arc());
        self
    }

    /// Adds a mesh in world space with the material of that name.
    pub fn shape(
        self,
        name: impl Into<String>,
        mesh: TriangleMesh,
        material: impl Into<String>,
    ) -> Self {
        self.add_shape(name.into(), mesh, Some(material.into()), None)
    }

    /// Adds a mesh in world space that emits light and reflects none.
    pub fn lamp(self, name: impl Into<String>, mesh: TriangleMesh, emission: Emission) -> Self {
        self.add_shape(name.into(), mesh, None, Some(emission))
    }

    /// Adds a mesh in world space that emits light and has the material of that name.
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
        let emission = emission.map(NewEmission::Constant);
        self.shapes.push(NewShape { name, mesh, material, emission });
        self
    }

    /// Adds a mesh in world space as the surface of a light of any kind. The light has to sample the same mesh (see
    /// [`LightSample::from_surface`](crate::light::LightSample::from_surface)), or to return `None` from
    /// [`Light::sample_li`] and 0 from [`Light::pdf_li`]. Rays that hit the mesh call [`Light::le`] and [`Light::pdf_li`] with the hit, so that
    /// emission may vary over the surface. Without a material the surface reflects nothing.
    pub fn shape_with_light(
        mut self,
        name: impl Into<String>,
        mesh: TriangleMesh,
        material: Option<&str>,
        light: impl Light + 'static,
    ) -> Self {
        let (name, material) = (name.into(), material.map(str::to_owned));
        let emission = Some(NewEmission::Light(light.into_arc()));
        self.shapes.push(NewShape { name, mesh, material, emission });
        self
    }

    /// Adds a light. To share it, pass an [`Arc`].
    pub fn light(mut self, light: impl Light + 'static) -> Self {
        self.lights.push(light.into_arc());
        self
    }

    /// Chooses the instruction set that the acceleration structure is built for, rays are traced and hits are shaded with, for
    /// measuring and tests. Default: the fastest that the processor has. All give the same picture.
    pub fn instruction_set(self, instruction_set: InstructionSet) -> Self {
        Self { instruction_set, ..self }
    }

    /// Checks the scene and builds its acceleration structure.
    ///
    /// # Errors
    /// The first invalid mesh, emission or unknown material, or too many triangles. Lights and materials are taken as
    /// they are.
    pub fn build(self) -> Result<Scene, SceneError> {
        let mut shapes = Vec::with_capacity(self.shapes.len());
        let mut meshes = Vec::with_capacity(self.shapes.len());
        let mut lights = self.lights;
        let mut materials: Vec<Arc<dyn Material>> = Vec::new();
        let mut indices = BTreeMap::new();
        for NewShape { name, mesh, material, emission } in self.shapes {
            mesh.check().map_err(|error| SceneError::Mesh(name.clone(), error))?;
            if let Some(NewEmission::Constant(Emission { radiance, .. })) = emission
                && !radiance.is_valid()
            {
                return Err(SceneError::Emission { shape: name, radiance: radiance.to_array() });
            }
            let index = indices.entry(material.clone());
            let material = match (index, material) {
                (Entry::Occupied(known), _) => *known.get(),
                (Entry::Vacant(new), material) => {
                    materials.push(match material {
                        Some(material) => match self.materials.get(&material) {
                            Some(found) => found.clone(),
                            None => {
                                return Err(SceneError::UnknownMaterial { shape: name, material });
                            }
                        },
                        None => Arc::new(MatteMaterial::new(Spectrum::BLACK)),
                    });
                    *new.insert(materials.len() as u32 - 1)
                }
            };
            // A mesh without area neither is visible nor emits.
            let light: Option<Arc<dyn Light>> = emission.and_then(|emission| match emission {
                NewEmission::Constant(Emission { radiance, two_sided }) => {
                    AreaLight::new(&mesh, radiance, two_sided).map(|light| Arc::new(light) as _)
                }
                NewEmission::Light(light) => Some(light),
            });
            let light = light.map(|light| {
                lights.push(light);
                lights.len() - 1
            });
            shapes.push(Shape { name, material, light });
            meshes.push(mesh);
        }
        let triangles = meshes.iter().map(|mesh| mesh.indices.len()).sum();
        if triangles > Accel::MAX_TRIANGLES {
            return Err(SceneError::TooManyTriangles(triangles));
        }
        let start = Stopwatch::start();
        let accel = Accel::build_for(self.instruction_set, &meshes);
        Ok(Scene {
            last_vertices: meshes.iter().map(LastVertex::of).collect(),
            shapes,
            meshes,
            lights,
            materials,
            accel,
            build_seconds: start.seconds(),
        })
    }
}
