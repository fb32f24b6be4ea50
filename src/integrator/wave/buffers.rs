//! [`Wave`]: the samples that an integrator processes together, and the buffers of one worker thread.

use glam::{Vec2, Vec3};

use super::counters::Counters;
use super::dimension;
use super::paths::Paths;
use super::shadow_rays::ShadowRays;
use crate::accel::Hit;
use crate::bxdf::Arena;
use crate::camera;
use crate::geometry::{PixelCone, Ray};
use crate::sampling::{SampleId, Sampler};
use crate::scene::{Scene, View};
use crate::spectrum::Spectrum;

/// A batch of camera samples, and the buffers that one worker reuses for each batch. Element i of `ids`, `rays`,
/// `hits` and `radiance` belongs to the same sample.
#[derive(Default)]
pub struct Wave<'a> {
    /// Pixel and sample index.
    pub ids: Vec<SampleId>,
    /// Sample values for the filter and the lens.
    film: Vec<Vec2>,
    lens: Vec<Vec2>,
    /// How wide pixels are, if the camera tells.
    pub(crate) cone: Option<PixelCone>,
    /// Camera rays.
    pub rays: Vec<Ray>,
    /// Closest hits of the camera rays.
    pub hits: Vec<Hit>,
    /// Radiance along the camera rays.
    pub radiance: Vec<Spectrum>,
    /// Buffer for shadow rays.
    pub shadow: ShadowRays,
    /// Path states.
    pub(crate) paths: Paths,
    /// Memory for lobes of other crates.
    pub arena: Arena,
    /// Rays traced and errors counted so far.
    pub counters: Counters,
    /// Tells whether the render is to end.
    cancelled: Option<&'a (dyn Fn() -> bool + Sync)>,
    /// Whether it said so to [`is_cancelled`](Self::is_cancelled).
    is_cut: bool,
}

impl<'a> Wave<'a> {
    /// Bytes that [`with_capacity`](Self::with_capacity) allocates.
    pub fn bytes(samples: usize, shadow_rays: usize, materials: usize) -> usize {
        let camera_ray = size_of::<SampleId>()
            + 2 * size_of::<Vec2>()
            + size_of::<Ray>()
            + size_of::<Hit>()
            + size_of::<Spectrum>();
        samples * camera_ray
            + Paths::bytes(samples, materials)
            + ShadowRays::bytes(samples * shadow_rays)
    }

    /// Whether the render was cancelled or its time is over. For integrators whose work on a wave has no bound: once it
    /// is true they return, and the wave is discarded.
    pub fn is_cancelled(&mut self) -> bool {
        self.is_cut |= self.cancelled.is_some_and(|cancelled| cancelled());
        self.is_cut
    }

    /// Whether its radiance is incomplete, since [`is_cancelled`](Self::is_cancelled) was true.
    pub(crate) fn is_cut(&self) -> bool {
        self.is_cut
    }

    /// A wave with capacity for `samples` samples, and for `shadow_rays` shadow rays each, in a scene of so many materials, of
    /// a render that ends when `cancelled` says so.
    pub fn with_capacity(
        samples: usize,
        shadow_rays: usize,
        materials: usize,
        cancelled: &'a (dyn Fn() -> bool + Sync),
    ) -> Self {
        Self {
            ids: Vec::with_capacity(samples),
            film: Vec::with_capacity(samples),
            lens: Vec::with_capacity(samples),
            rays: Vec::with_capacity(samples),
            hits: Vec::with_capacity(samples),
            radiance: Vec::with_capacity(samples),
            shadow: ShadowRays::with_capacity(samples * shadow_rays),
            paths: Paths::with_capacity(samples, materials),
            cancelled: Some(cancelled),
            ..Self::default()
        }
    }

    /// Generates the camera rays of the samples in `ids`, and intersects them with the scene.
    pub fn begin(&mut self, scene: &Scene, view: &View, sampler: &dyn Sampler) {
        let Self { ids, film, lens, cone, rays, hits, radiance, counters, .. } = self;
        *cone = view.camera().pixel_cone();
        film.resize(ids.len(), Vec2::ZERO);
        sampler.fill_2d(ids, dimension::FILM, film);
        lens.resize(ids.len(), Vec2::ZERO);
        if view.camera().has_lens() {
            sampler.fill_2d(ids, dimension::LENS, lens);
        }
        view.generate_rays(scene.instruction_set(), ids, film, lens, rays);
        radiance.clear();
        radiance.resize(rays.len(), Spectrum::BLACK);
        camera::prepare(scene.instruction_set(), rays, |i, ray| {
            // A negative t_max hits nothing, and the film rejects NaN, whatever is added to it.
            *ray = Ray { t_max: -1.0, ..Ray::new(Vec3::ZERO, Vec3::Z) };
            radiance[i] = Spectrum::splat(f32::NAN);
            counters.refused_camera_rays += 1;
        });
        counters.camera_rays += rays.len() as u64;
        // The previous contents are overwritten.
        hits.resize(rays.len(), Hit::MISS);
        scene.intersect(rays, hits);
    }
}
