//! Scenes: what there is to be rendered, and how.

mod builder;
mod settings;

use std::sync::Arc;

pub use crate::sampling::SamplerKind;
pub use builder::{SceneBuilder, SceneError};
pub use settings::{Emission, FilmSettings, IntegratorSettings, LightStrategy, SamplerSettings};

use glam::Vec3;

use crate::accel::{Accel, Hit};
use crate::bxdf::LambertianReflection;
use crate::camera::{Camera, CameraSettings};
use crate::film::FilterSampler;
use crate::geometry::Ray;
use crate::interaction::SurfaceInteraction;
use crate::light::{BoundingSphere, KnownLight, Light};
use crate::material::Material;
use crate::shape::TriangleMesh;

/// A checked scene, ready to be rendered. It is made by [`Scene::builder`], or read from a file by
/// [`read_scene`](crate::scene_file::read_scene).
///
/// ```
/// use lobe::glam::Vec3;
/// use lobe::scene::{IntegratorSettings, Scene};
/// use lobe::{CameraSettings, MatteMaterial, PointLight, Spectrum, TriangleMesh};
///
/// let floor = TriangleMesh {
///     positions: vec![Vec3::NEG_X, Vec3::X, Vec3::Z * 2.0],
///     indices: vec![[0, 1, 2]],
///     ..TriangleMesh::default()
/// };
/// let scene = Scene::builder()
///     .camera(CameraSettings { eye: Vec3::new(0.0, 2.0, -1.0), look_at: Vec3::Z, ..Default::default() })
///     .resolution(64, 48)
///     .integrator(IntegratorSettings::direct())
///     .material("clay", MatteMaterial::new([0.6, 0.3, 0.2]))
///     .shape("floor", floor, "clay")
///     .light(PointLight::new(Vec3::Y, Spectrum::splat(10.0)))
///     .build()?;
/// assert_eq!(scene.accel().triangle_count(), 1);
/// # Ok::<(), lobe::scene::SceneError>(())
/// ```
pub struct Scene {
    camera: Camera,
    camera_settings: CameraSettings,
    film: FilmSettings,
    filter: FilterSampler,
    sampler: SamplerSettings,
    integrator: IntegratorSettings,
    shapes: Vec<Shape>,
    meshes: Vec<TriangleMesh>,
    lights: Vec<Arc<dyn Light>>,
    /// By light: those of kinds that are sampled four at a time.
    known_lights: Vec<Option<KnownLight>>,
    is_plain: bool,
    accel: Accel,
    build_seconds: f64,
}

/// What there is to know of a mesh beside its triangles.
struct Shape {
    name: String,
    material: Arc<dyn Material>,
    /// The number of the light that it is.
    light: Option<usize>,
    /// What it reflects, if that takes no more than its plane and this to know.
    plain: Option<LambertianReflection>,
}

impl Scene {
    /// An empty scene to add to.
    pub fn builder() -> SceneBuilder {
        SceneBuilder::default()
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The camera's settings.
    pub fn camera_settings(&self) -> &CameraSettings {
        &self.camera_settings
    }

    /// The film's settings.
    pub fn film(&self) -> &FilmSettings {
        &self.film
    }

    /// The film's filter, ready to be sampled.
    pub fn filter(&self) -> &FilterSampler {
        &self.filter
    }

    /// The sampler's settings.
    pub fn sampler(&self) -> &SamplerSettings {
        &self.sampler
    }

    /// Changes the sampler's settings: they take no part in what is built.
    pub fn set_sampler(&mut self, sampler: SamplerSettings) {
        self.sampler = sampler;
    }

    /// The integrator's settings.
    pub fn integrator(&self) -> &IntegratorSettings {
        &self.integrator
    }

    /// The lights.
    pub fn lights(&self) -> &[Arc<dyn Light>] {
        &self.lights
    }

    /// The tree of all triangles.
    pub fn accel(&self) -> &Accel {
        &self.accel
    }

    /// The shapes' names and meshes, in the order in which they were added.
    pub fn shapes(&self) -> impl Iterator<Item = (&str, &TriangleMesh)> {
        self.shapes.iter().map(|s| s.name.as_str()).zip(&self.meshes)
    }

    /// A ball around all triangles.
    pub fn bounding_sphere(&self) -> BoundingSphere {
        let bounds = self.accel.bounds();
        if bounds.is_empty() {
            return BoundingSphere::default();
        }
        // Halved first: the sum of two large coordinates is larger.
        let (min, max) = (bounds.min / 2.0, bounds.max / 2.0);
        BoundingSphere { center: min + max, radius: (max - min).length() }
    }

    /// The number of the light that the surface is at a hit.
    ///
    /// # Panics
    /// Like [`Scene::interaction`].
    #[inline]
    pub fn light_at(&self, hit: &Hit) -> Option<usize> {
        self.shapes[hit.shape as usize].light
    }

    /// The numbers of the lights that surfaces are.
    pub fn lights_on_surfaces(&self) -> impl Iterator<Item = usize> {
        self.shapes.iter().filter_map(|shape| shape.light)
    }

    /// The lights of kinds that can be sampled four at a time, by their numbers.
    pub(crate) fn known_lights(&self) -> &[Option<KnownLight>] {
        &self.known_lights
    }

    /// The only lobe that the surface has at a hit, where it has a constant one on flat triangles. A miss
    /// has none.
    #[inline]
    pub(crate) fn plain(&self, hit: &Hit) -> Option<&LambertianReflection> {
        self.shapes.get(hit.shape as usize)?.plain.as_ref()
    }

    /// Whether all of its surfaces are of that kind.
    #[inline]
    pub(crate) fn is_plain(&self) -> bool {
        self.is_plain
    }

    /// The corners of the triangle that was hit.
    ///
    /// # Panics
    /// Like [`Scene::interaction`].
    #[inline(always)]
    pub(crate) fn corners(&self, hit: &Hit) -> [&Vec3; 3] {
        let TriangleMesh { positions, indices, .. } = &self.meshes[hit.shape as usize];
        let [a, b, c] = indices[hit.triangle as usize];
        [&positions[a as usize], &positions[b as usize], &positions[c as usize]]
    }

    /// How long the tree took to build, in seconds.
    pub fn build_seconds(&self) -> f64 {
        self.build_seconds
    }

    /// What is known about a hit of `ray`, whose direction has unit length.
    ///
    /// # Panics
    /// If `hit` is none of this scene's: a miss, or one from elsewhere.
    #[inline]
    pub fn interaction(&self, ray: &Ray, hit: &Hit) -> SurfaceInteraction<'_> {
        let mesh = &self.meshes[hit.shape as usize];
        SurfaceInteraction::on_triangle(mesh, hit.triangle as usize, hit.b, -ray.d)
    }

    /// What the surface is made of at a hit.
    ///
    /// # Panics
    /// Like [`Scene::interaction`].
    #[inline]
    pub fn material(&self, hit: &Hit) -> &dyn Material {
        &*self.shapes[hit.shape as usize].material
    }
}
