//! [`Scene`]: shapes, materials, lights, and the acceleration structure.

use std::sync::Arc;

use crate::accel::{Accel, Hit, InstructionSet};
use crate::bxdf::{Arena, Bsdf, BsdfBlock};
use crate::geometry::{PixelCone, Ray};
use crate::interaction::{HitBlock, SurfaceInteraction, SurfacePlace, Surfaces};
use crate::light::{BoundingSphere, Light};
use crate::material::Material;
use crate::shape::TriangleMesh;

/// Shapes, materials, lights, and the acceleration structure over all triangles: checked and ready to render.
/// [`Scene::builder`] makes one, or [`read_scene`](crate::scene_file::read_scene) from a file.
///
/// ```
/// use lobe::glam::Vec3;
/// use lobe::{MatteMaterial, PointLight, Scene, Spectrum, TriangleMesh};
///
/// let floor = TriangleMesh {
///     positions: vec![Vec3::NEG_X, Vec3::X, Vec3::Z * 2.0],
///     indices: vec![[0, 1, 2]],
///     ..TriangleMesh::default()
/// };
/// let scene = Scene::builder()
///     .material("clay", MatteMaterial::new([0.6, 0.3, 0.2]))
///     .shape("floor", floor, "clay")
///     .light(PointLight::new(Vec3::Y, Spectrum::splat(10.0)))
///     .build()?;
/// assert_eq!(scene.accel().triangle_count(), 1);
/// # Ok::<(), lobe::scene::SceneError>(())
/// ```
pub struct Scene {
    pub(super) shapes: Vec<Shape>,
    pub(super) surfaces: Surfaces,
    /// Of each instance.
    pub(super) instance_names: Vec<String>,
    pub(super) lights: Vec<Arc<dyn Light>>,
    /// Those that shapes have, each once.
    pub(super) materials: Vec<Arc<dyn Material>>,
    /// Whether a material lets rays pass.
    pub(super) has_holes: bool,
    pub(super) accel: Accel,
    pub(super) build_seconds: f64,
}

/// A mesh's name, materials and light.
pub(super) struct Shape {
    pub name: String,
    /// Index of its first material, or its only one.
    pub material: u32,
    /// Index of the material of each triangle; empty if there is only one.
    pub materials: Vec<u32>,
    /// Index of its area light, if it emits.
    pub light: Option<usize>,
    /// Index of the shape that it is a copy of, in place of an instance.
    pub copy_of: Option<usize>,
}

/// What the surface of a hit belongs to: see [`Scene::shape_of`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ShapeOf {
    /// Index of the shape among [`Scene::shapes`].
    pub shape: usize,
    /// Index of the instance among [`Scene::instances`], if it is not the shape itself that was hit.
    pub instance: Option<usize>,
}

impl Scene {
    /// All lights. Area lights of shapes come last.
    pub fn lights(&self) -> &[Arc<dyn Light>] {
        &self.lights
    }

    /// The acceleration structure over all triangles.
    pub fn accel(&self) -> &Accel {
        &self.accel
    }

    /// Name and mesh of each shape, in the order in which they were added.
    pub fn shapes(&self) -> impl Iterator<Item = (&str, &TriangleMesh)> {
        self.shapes.iter().map(|s| s.name.as_str()).zip(self.surfaces.meshes())
    }

    /// Name of each instance, and that of its shape, in the order in which they were added. Those that are copies of their shape are
    /// shapes.
    pub fn instances(&self) -> impl Iterator<Item = (&str, &str)> {
        let shapes = self.surfaces.instances().iter().map(|i| &self.shapes[i.mesh as usize]);
        self.instance_names.iter().map(String::as_str).zip(shapes.map(|s| s.name.as_str()))
    }

    /// Name of each shape that is a copy because it could not be an instance, and that of the shape it was copied from. They are the last of
    /// [`shapes`](Self::shapes).
    pub fn copies(&self) -> impl Iterator<Item = (&str, &str)> {
        let of = |shape: &Shape| shape.copy_of.map(|of| &*self.shapes[of].name);
        self.shapes.iter().filter_map(move |shape| Some((&*shape.name, of(shape)?)))
    }

    /// Shape and instance for the index that a hit has, [`Hit::shape`] or [`SurfacePlace::shape`]: shapes come first, then instances.
    /// `None` for a miss, and for indices beyond these.
    pub fn shape_of(&self, index: u32) -> Option<ShapeOf> {
        let index = index as usize;
        let Some(instance) = index.checked_sub(self.shapes.len()) else {
            return Some(ShapeOf { shape: index, instance: None });
        };
        let shape = self.surfaces.instances().get(instance)?.mesh as usize;
        Some(ShapeOf { shape, instance: Some(instance) })
    }

    #[inline]
    fn shape_at(&self, hit: &Hit) -> &Shape {
        &self.shapes[self.surfaces.mesh_index(hit.shape)]
    }

    /// A sphere around all triangles.
    pub fn bounding_sphere(&self) -> BoundingSphere {
        let bounds = self.accel.bounds();
        if bounds.is_empty() {
            return BoundingSphere::default();
        }
        // Halved first: the sum of two large coordinates is larger.
        let (min, max) = (bounds.min / 2.0, bounds.max / 2.0);
        BoundingSphere { center: min + max, radius: (max - min).length() }
    }

    /// Index of the area light to which the surface at a hit belongs, if it emits.
    ///
    /// # Panics
    /// Like [`Scene::interaction`].
    #[inline]
    pub fn light_at(&self, hit: &Hit) -> Option<usize> {
        self.shape_at(hit).light
    }

    /// Indices of the area lights.
    pub fn lights_on_surfaces(&self) -> impl Iterator<Item = usize> {
        self.shapes.iter().filter_map(|shape| shape.light)
    }

    /// The instruction set that hits are shaded with: the one that rays are traced with.
    #[inline]
    pub(crate) fn instruction_set(&self) -> InstructionSet {
        self.accel.instruction_set()
    }

    /// An empty block of hits on this scene's surfaces.
    pub(crate) fn hit_block<'a>(&'a self, cone: Option<&'a PixelCone>) -> HitBlock<'a> {
        HitBlock::new(&self.surfaces, cone, self.instruction_set())
    }

    /// Index of the material at a hit. Shapes may share one.
    #[inline]
    pub(crate) fn material_at(&self, hit: &Hit) -> u32 {
        let shape = self.shape_at(hit);
        *shape.materials.get(hit.triangle as usize).unwrap_or(&shape.material)
    }

    /// Number of materials.
    pub(crate) fn material_count(&self) -> usize {
        self.materials.len()
    }

    /// The lobes at a block of hits on surfaces of one material.
    #[inline]
    pub(crate) fn scatter_block<'a>(
        &'a self,
        material: u32,
        hits: &mut HitBlock,
        arena: &'a Arena,
        bsdfs: &mut BsdfBlock<'a>,
    ) {
        bsdfs.clear();
        self.materials[material as usize].scatter_block(hits, arena, bsdfs);
        assert_eq!(bsdfs.len(), hits.len(), "a material fills the lobes of all hits of a block");
    }

    /// Wall-clock time to build the acceleration structure, in seconds.
    pub fn build_seconds(&self) -> f64 {
        self.build_seconds
    }

    /// The surface at a hit of `ray`, whose direction must have unit length.
    ///
    /// # Panics
    /// If `hit` is a miss, or a hit in another scene.
    #[inline]
    pub fn interaction(&self, ray: &Ray, hit: &Hit) -> SurfaceInteraction<'_> {
        let mesh = self.surfaces.placed(hit.shape);
        let place = SurfacePlace { shape: hit.shape, triangle: hit.triangle, b: hit.b };
        SurfaceInteraction::on_shape(mesh, place, -ray.d)
    }

    /// The same as a camera with this cone sees it, so that textures are filtered.
    ///
    /// # Panics
    /// Like [`Scene::interaction`].
    pub(crate) fn seen<'a>(
        &'a self,
        ray: &Ray,
        hit: &Hit,
        cone: Option<&'a PixelCone>,
    ) -> SurfaceInteraction<'a> {
        let si = self.interaction(ray, hit);
        if let Some(cone) = cone { si.seen_by(cone) } else { si }
    }

    /// The lobes at a hit. The material may replace the shading geometry of `si`.
    ///
    /// # Panics
    /// Like [`Scene::interaction`].
    #[inline]
    pub fn bsdf<'a>(
        &'a self,
        hit: &Hit,
        si: &mut SurfaceInteraction,
        arena: &'a Arena,
    ) -> Bsdf<'a> {
        self.materials[self.material_at(hit) as usize].compute_scattering(si, arena)
    }
}
