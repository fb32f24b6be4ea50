//! [`Wave`]: the samples that go through an integrator together.

mod paths;
pub mod plain;
mod plain_lights;
mod rules;
mod vertices;

pub use paths::{Path, Paths};
pub use rules::{PathRules, power_heuristic};
pub use vertices::Vertices;

use glam::{Vec2, Vec3};
use plain::push_x4;

use crate::accel::Hit;
use crate::bxdf::Arena;
use crate::camera;
use crate::geometry::Ray;
use crate::sampling::{SampleId, Sampler};
use crate::scene::{Scene, View};
use crate::spectrum::Spectrum;

/// Which dimension of a sample is used for what.
pub mod dimension {
    /// The place within the pixel, 2D.
    pub const FILM: u32 = 0;
    /// The place on the lens, 2D.
    pub const LENS: u32 = 1;
    /// The first one for the lights: those of a hit follow each other, and those of the next reflection
    /// follow them.
    pub const FIRST_LIGHT: u32 = 2;

    /// Of a hit: the direction in which the path goes on, 2D.
    pub(crate) const DIRECTION: u32 = 0;
    /// Of a hit: the place on the light, 2D.
    pub(crate) const LIGHT: u32 = 1;
    /// Of a hit: which light, 1D.
    pub(crate) const CHOICE: u32 = 2;
    /// Of a hit: whether the path ends, 1D.
    pub(crate) const ROULETTE: u32 = 3;
    /// The places on the second light, 2D, and on all others, where each is asked for: direct light, which has one
    /// reflection.
    pub(crate) const MORE_LIGHTS: u32 = of_depth(1);

    /// Of a hit after so many reflections: the choice between lobes and their events, 1D, where there is one.
    /// Far from all others, so that a surface that has none leaves them as they are.
    pub(crate) const fn event(depth: u32) -> u32 {
        1 << 31 | depth
    }

    /// The first dimension of a hit after so many reflections.
    pub(crate) const fn of_depth(depth: u32) -> u32 {
        FIRST_LIGHT.wrapping_add(depth.wrapping_mul(4))
    }
}

/// What a render did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Rays from the camera.
    pub camera_rays: u64,
    /// Rays towards lights.
    pub shadow_rays: u64,
    /// Rays that go on from a surface to whatever they meet.
    pub scattered_rays: u64,
    /// What Bsdfs refused: see [`Bsdf::rejected`](crate::bxdf::Bsdf::rejected).
    pub rejected: u64,
    /// Camera rays that could not be traced: see [`Camera`](crate::camera::Camera). Their samples are left out of the
    /// picture and counted among those that are not finite, too.
    pub refused_camera_rays: u64,
}

impl Counters {
    /// All rays.
    pub fn rays(&self) -> u64 {
        self.camera_rays + self.shadow_rays + self.scattered_rays
    }

    /// Adds what another worker did.
    pub fn add(&mut self, other: &Self) {
        self.camera_rays += other.camera_rays;
        self.shadow_rays += other.shadow_rays;
        self.scattered_rays += other.scattered_rays;
        self.rejected += other.rejected;
        self.refused_camera_rays += other.refused_camera_rays;
    }
}

/// A batch of camera samples with all that is known of each, and the buffers that one worker uses
/// over and over. Element i of ids, rays, hits and radiance belongs to the same sample.
#[derive(Default)]
pub struct Wave {
    /// Pixel and index.
    pub ids: Vec<SampleId>,
    /// Sample values for the points of pixel and lens.
    film: Vec<Vec2>,
    lens: Vec<Vec2>,
    /// Rays from the camera.
    pub rays: Vec<Ray>,
    /// What they hit.
    pub hits: Vec<Hit>,
    /// What arrives along them.
    pub radiance: Vec<Spectrum>,
    /// Rays towards lights.
    pub shadow: ShadowRays,
    /// Paths under way.
    pub(crate) paths: Paths,
    /// Memory for lobes.
    pub arena: Arena,
    /// What was done so far.
    pub counters: Counters,
}

impl Wave {
    /// A wave with room for `samples` samples, and for `shadow_rays` rays towards lights from each.
    pub fn with_capacity(samples: usize, shadow_rays: usize) -> Self {
        Self {
            ids: Vec::with_capacity(samples),
            film: Vec::with_capacity(samples),
            lens: Vec::with_capacity(samples),
            rays: Vec::with_capacity(samples),
            hits: Vec::with_capacity(samples),
            radiance: Vec::with_capacity(samples),
            shadow: ShadowRays::with_capacity(samples * shadow_rays),
            paths: Paths::with_capacity(samples),
            ..Self::default()
        }
    }

    /// Starts anew with the camera rays of the samples in `ids`, and finds what they hit.
    pub fn begin(&mut self, scene: &Scene, view: &View, sampler: &dyn Sampler) {
        let Self { ids, film, lens, rays, hits, radiance, counters, .. } = self;
        sampler.fill_2d(ids, dimension::FILM, film);
        if view.camera().has_lens() {
            sampler.fill_2d(ids, dimension::LENS, lens);
        } else {
            lens.clear();
            lens.resize(ids.len(), Vec2::ZERO);
        }
        view.generate_rays(ids, film, lens, rays);
        radiance.clear();
        radiance.resize(rays.len(), Spectrum::BLACK);
        for (ray, radiance) in rays.iter_mut().zip(&mut *radiance) {
            if !camera::prepare(ray) {
                // Hits nothing; and whatever is added to NaN, the film leaves the sample out.
                *ray = Ray { t_max: -1.0, ..Ray::new(Vec3::ZERO, Vec3::Z) };
                *radiance = Spectrum::splat(f32::NAN);
                counters.refused_camera_rays += 1;
            }
        }
        counters.camera_rays += rays.len() as u64;
        // What is left of other rays is overwritten.
        hits.resize(rays.len(), Hit::MISS);
        scene.accel().intersect(rays, hits);
    }
}

/// Rays towards lights, each with what it carries to which sample if nothing stands in its way.
#[derive(Default)]
pub struct ShadowRays {
    rays: Vec<Ray>,
    samples: Vec<u32>,
    carried: Vec<Spectrum>,
    occluded: Vec<bool>,
}

impl ShadowRays {
    fn with_capacity(rays: usize) -> Self {
        Self {
            // One more is there for a moment.
            rays: Vec::with_capacity(rays + 1),
            samples: Vec::with_capacity(rays + 1),
            carried: Vec::with_capacity(rays + 1),
            occluded: Vec::with_capacity(rays),
        }
    }

    /// Adds a ray for the sample with this number in the wave.
    #[inline]
    pub fn push(&mut self, sample: usize, ray: Ray, radiance: Spectrum) {
        self.rays.push(ray);
        self.samples.push(sample as u32);
        self.carried.push(radiance);
    }

    /// Adds those rays of four paths whose bits in the mask are set.
    #[inline(always)]
    pub(super) fn push_x4(
        &mut self,
        mask: u32,
        paths: [&Path; 4],
        rays: &[Ray; 4],
        radiance: &[Spectrum; 4],
    ) {
        push_x4(&mut self.rays, mask, rays);
        push_x4(&mut self.samples, mask, &paths.map(|path| path.sample));
        push_x4(&mut self.carried, mask, radiance);
    }

    /// Traces all rays, adds what gets through to `radiance`, and returns how many they were.
    pub fn trace(&mut self, scene: &Scene, radiance: &mut [Spectrum]) -> u64 {
        self.occluded.resize(self.rays.len(), false);
        scene.accel().occluded(&self.rays, &mut self.occluded);
        for ((&sample, &carried), &occluded) in
            self.samples.iter().zip(&self.carried).zip(&self.occluded)
        {
            radiance[sample as usize] += if occluded { Spectrum::BLACK } else { carried };
        }
        let count = self.rays.len() as u64;
        self.rays.clear();
        self.samples.clear();
        self.carried.clear();
        count
    }
}
