//! [`SceneBuilder`]: a scene part by part.

use std::any::Any;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Instant;

use super::{Emission, Scene, Shape};
use crate::accel::Accel;
use crate::bxdf::LambertianReflection;
use crate::light::{AreaLight, KnownLight, Light};
use crate::material::{Material, MatteMaterial};
use crate::shape::{MeshError, TriangleMesh};
use crate::spectrum::Spectrum;

/// Why a scene cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// A shape names a material that the scene does not have.
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

/// A material, and its lobe if that is one constant Lambertian.
type NewMaterial = (Arc<dyn Material>, Option<LambertianReflection>);

/// Collects the parts of a [`Scene`] in any order, and checks them at the end.
#[derive(Default)]
pub struct SceneBuilder {
    materials: BTreeMap<String, NewMaterial>,
    shapes: Vec<NewShape>,
    lights: Vec<Arc<dyn Light>>,
    known_lights: Vec<Option<KnownLight>>,
}

impl SceneBuilder {
    /// Adds a material; one of the same name is replaced.
    pub fn material(mut self, name: impl Into<String>, material: impl Material + 'static) -> Self {
        let matte = (&material as &dyn Any).downcast_ref::<MatteMaterial>();
        let plain = matte.and_then(MatteMaterial::plain);
        self.materials.insert(name.into(), (Arc::new(material), plain));
        self
    }

    /// Adds a material that is shared with others.
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

    /// Adds a mesh in world space that emits light and reflects none.
    pub fn lamp(self, name: impl Into<String>, mesh: TriangleMesh, emission: Emission) -> Self {
        self.add_shape(name.into(), mesh, None, Some(emission))
    }

    /// Adds a mesh in world space that emits light, made of the material of that name.
    pub fn glowing_shape(
        self,
        name: impl Into<String>,
        mesh: TriangleMesh,
        material: impl Into<String>,
        emission: Emission,
    ) -> Self {
        self.add_shape(name.into(), mesh, Some(material.into()), Some(emission))
    }

    pub(super) fn add_shape(
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

    /// Checks the scene and builds its tree.
    ///
    /// # Errors
    /// The first mesh or name that is wrong, or too many triangles.
    pub fn build(self) -> Result<Scene, SceneError> {
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
            shapes,
            meshes,
            lights,
            known_lights,
            is_plain,
            accel,
            build_seconds: start.elapsed().as_secs_f64(),
        })
    }
}
