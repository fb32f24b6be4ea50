//! [`SceneBuilder`]: collects shapes, materials and lights, and builds a [`Scene`].

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;

use glam::Affine3A;

use super::error::SceneError;
use super::instances::{NewInstance, instances};
use super::model::{Scene, Shape};
use super::new_shape::{NewEmission, NewMaterial, NewShape};
use super::settings::Emission;
use crate::accel::{Accel, InstructionSet};
use crate::clock::Stopwatch;
use crate::interaction::Surfaces;
use crate::light::{AreaLight, Light, TexturedAreaLight};
use crate::material::{Material, MatteMaterial};
use crate::shape::TriangleMesh;
use crate::spectrum::Spectrum;
use crate::texture::Texture;

/// Collects the parts of a [`Scene`] in any order. [`build`](Self::build) checks them.
#[derive(Default)]
pub struct SceneBuilder {
    materials: BTreeMap<String, Arc<dyn Material>>,
    shapes: Vec<NewShape>,
    instances: Vec<NewInstance>,
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
        self.add_shape(name.into(), mesh, Some(material.into()), None::<Emission>)
    }

    /// Adds a mesh in world space whose triangles differ in material: for each, an index into `materials`.
    pub fn shape_with_materials(
        mut self,
        name: impl Into<String>,
        mesh: TriangleMesh,
        materials: Vec<String>,
        of_triangles: Vec<u32>,
    ) -> Self {
        let (name, material) = (name.into(), NewMaterial::ByTriangle(materials, of_triangles));
        self.shapes.push(NewShape { name, mesh, material, emission: None, copy_of: None });
        self
    }

    /// Adds a mesh in world space that emits light and reflects none.
    pub fn lamp(
        self,
        name: impl Into<String>,
        mesh: TriangleMesh,
        emission: Emission<impl Texture<Spectrum> + 'static>,
    ) -> Self {
        self.add_shape(name.into(), mesh, None, Some(emission))
    }

    /// Adds a mesh in world space that emits light and has the material of that name.
    pub fn glowing_shape(
        self,
        name: impl Into<String>,
        mesh: TriangleMesh,
        material: impl Into<String>,
        emission: Emission<impl Texture<Spectrum> + 'static>,
    ) -> Self {
        self.add_shape(name.into(), mesh, Some(material.into()), Some(emission))
    }

    pub(crate) fn add_shape(
        mut self,
        name: String,
        mesh: TriangleMesh,
        material: Option<String>,
        emission: Option<Emission<impl Texture<Spectrum> + 'static>>,
    ) -> Self {
        let emission = emission.map(|Emission { radiance, two_sided }| {
            NewEmission::Own(Emission { radiance: radiance.into_handle(), two_sided })
        });
        let material = NewMaterial::Everywhere(material);
        self.shapes.push(NewShape { name, mesh, material, emission, copy_of: None });
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
        let (name, material) = (name.into(), NewMaterial::Everywhere(material.map(str::to_owned)));
        let emission = Some(NewEmission::Light(light.into_arc()));
        self.shapes.push(NewShape { name, mesh, material, emission, copy_of: None });
        self
    }

    /// Adds the shape of that name once more, moved by `transform` from where it stands, without a copy of its mesh. Shapes that
    /// emit are copied, and so are those that `transform` flattens.
    pub fn instance(
        mut self,
        name: impl Into<String>,
        shape: impl Into<String>,
        transform: Affine3A,
    ) -> Self {
        self.instances.push(NewInstance { name: name.into(), shape: shape.into(), transform });
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
    pub fn build(mut self) -> Result<Scene, SceneError> {
        for NewShape { name, mesh, .. } in &self.shapes {
            mesh.check().map_err(|error| SceneError::Mesh(name.clone(), error))?;
        }
        let (names, instances) = instances(&mut self.shapes, self.instances)?;
        let mut shapes = Vec::with_capacity(self.shapes.len());
        let mut meshes = Vec::with_capacity(self.shapes.len());
        let mut lights = self.lights;
        let mut known = Known { all: self.materials, used: Vec::new(), indices: BTreeMap::new() };
        for NewShape { name, mesh, material, emission, copy_of } in self.shapes {
            if let Some(NewEmission::Own(Emission { radiance, .. })) = &emission
                && let Some(radiance) = radiance.constant().filter(|radiance| !radiance.is_valid())
            {
                return Err(SceneError::Emission { shape: name, radiance: radiance.to_array() });
            }
            let (material, materials) = known.of_shape(&name, material, mesh.indices.len())?;
            let light = emission.and_then(|emission| light_of(shapes.len(), &mesh, emission));
            let light = light.map(|light| {
                lights.push(light);
                lights.len() - 1
            });
            shapes.push(Shape { name, material, materials, light, copy_of });
            meshes.push(mesh);
        }
        let start = Stopwatch::start();
        let accel = Accel::build_with_instances(self.instruction_set, &meshes, &instances);
        Ok(Scene {
            surfaces: Surfaces::new(meshes, instances),
            instance_names: names,
            shapes,
            lights,
            has_holes: known.used.iter().any(|material| material.opacity().is_some()),
            materials: known.used,
            accel,
            build_seconds: start.seconds(),
        })
    }
}

/// The light of the shape of this index. A mesh without area neither is visible nor emits.
fn light_of(shape: usize, mesh: &TriangleMesh, emission: NewEmission) -> Option<Arc<dyn Light>> {
    match emission {
        NewEmission::Own(Emission { radiance, two_sided }) => match radiance.constant() {
            Some(radiance) => Some(Arc::new(AreaLight::new(mesh, radiance, two_sided)?)),
            None => {
                let light = TexturedAreaLight::on_shape(shape as u32, mesh, radiance, two_sided);
                Some(Arc::new(light?))
            }
        },
        NewEmission::Light(light) => Some(light),
    }
}

/// The materials that shapes have so far.
struct Known {
    all: BTreeMap<String, Arc<dyn Material>>,
    used: Vec<Arc<dyn Material>>,
    /// Of `used`, by name.
    indices: BTreeMap<Option<String>, u32>,
}

impl Known {
    /// The index of a shape's first material, and that of each triangle if there are several.
    fn of_shape(
        &mut self,
        shape: &str,
        material: NewMaterial,
        triangles: usize,
    ) -> Result<(u32, Vec<u32>), SceneError> {
        let (names, of_triangles) = match material {
            NewMaterial::Everywhere(name) => return Ok((self.index(shape, name)?, Vec::new())),
            NewMaterial::ByTriangle(names, of_triangles) => (names, of_triangles),
        };
        let wrong = |reason: String| SceneError::Materials { shape: shape.to_owned(), reason };
        if of_triangles.len() != triangles {
            let found = of_triangles.len();
            return Err(wrong(format!("{found} materials for {triangles} triangles")));
        }
        if let Some(index) = of_triangles.iter().find(|&&index| index as usize >= names.len()) {
            let count = names.len();
            return Err(wrong(format!("material {index} of {count}, which count from 0")));
        }
        let names = names.into_iter().map(|name| self.index(shape, Some(name)));
        let indices: Vec<u32> = names.collect::<Result<_, _>>()?;
        let of_triangles: Vec<u32> =
            of_triangles.into_iter().map(|index| indices[index as usize]).collect();
        let first = of_triangles.first().copied().unwrap_or_default();
        let is_one = of_triangles.iter().all(|&index| index == first);
        Ok((first, if is_one { Vec::new() } else { of_triangles }))
    }

    /// The index of a material, which is added if it is new.
    fn index(&mut self, shape: &str, name: Option<String>) -> Result<u32, SceneError> {
        let Entry::Vacant(new) = self.indices.entry(name.clone()) else {
            return Ok(self.indices[&name]);
        };
        self.used.push(match name {
            Some(material) => match self.all.get(&material) {
                Some(found) => found.clone(),
                None => {
                    return Err(SceneError::UnknownMaterial { shape: shape.to_owned(), material });
                }
            },
            None => Arc::new(MatteMaterial::new(Spectrum::BLACK)),
        });
        Ok(*new.insert(self.used.len() as u32 - 1))
    }
}
