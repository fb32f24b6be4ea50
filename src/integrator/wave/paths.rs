//! [`Paths`]: the paths of a wave, and the buffers of the stages that process them.

use glam::{Vec2, Vec3};

use crate::accel::Hit;
use crate::geometry::Ray;
use crate::sampling::SampleId;
use crate::scene::Scene;
use crate::spectrum::Spectrum;

/// The state of a path, beside its ray.
#[derive(Clone, Copy)]
pub struct Path {
    /// β: path throughput divided by path density.
    pub beta: Spectrum,
    /// The surface point that its ray leaves, before the origin was offset. Not used for camera rays.
    pub p: Vec3,
    /// Density over solid angle of the ray's direction; infinite for camera rays and delta events.
    pub pdf: f32,
    /// Product of η² over all interfaces crossed. Refraction scales radiance by 1/η². Russian roulette undoes
    /// this, since the factor is undone when the path leaves the medium again.
    pub eta_scale: f32,
    /// Index of its sample in the wave.
    pub sample: u32,
}

/// Sample values of the active paths, one buffer per use. Buffers that a scene does not need stay empty.
#[derive(Default)]
pub struct Values {
    pub ids: Vec<SampleId>,
    pub direction: Vec<Vec2>,
    pub light: Vec<Vec2>,
    pub choice: Vec<f32>,
    pub roulette: Vec<f32>,
}

/// The paths of a wave. Element i of `states`, `rays` and `hits` belongs to the same path. At depth 0 the
/// states are `first`, and rays and hits are those of the wave.
#[derive(Default)]
pub struct Paths {
    /// Initial states of camera paths, the same in all waves.
    pub first: Vec<Path>,
    pub states: Vec<Path>,
    pub rays: Vec<Ray>,
    pub hits: Vec<Hit>,
    pub by_hit: PathsByHit,
    pub values: Values,
    /// `states` and `rays` at the next depth.
    pub next_states: Vec<Path>,
    pub next_rays: Vec<Ray>,
}

impl Paths {
    /// Bytes of all buffers for each path.
    pub const BYTES: usize = 3 * size_of::<Path>()
        + 2 * size_of::<Ray>()
        + size_of::<Hit>()
        + 3 * size_of::<u32>()
        + size_of::<SampleId>()
        + 2 * size_of::<Vec2>()
        + 2 * size_of::<f32>();

    /// Buffers with capacity for `paths` paths.
    pub fn with_capacity(paths: usize) -> Self {
        Self {
            first: Vec::with_capacity(paths),
            states: Vec::with_capacity(paths),
            rays: Vec::with_capacity(paths),
            hits: Vec::with_capacity(paths),
            by_hit: PathsByHit {
                active: Vec::with_capacity(paths),
                flat: 0,
                others: Vec::with_capacity(paths),
                escaped: Vec::with_capacity(paths),
            },
            values: Values {
                ids: Vec::with_capacity(paths),
                direction: Vec::with_capacity(paths),
                light: Vec::with_capacity(paths),
                choice: Vec::with_capacity(paths),
                roulette: Vec::with_capacity(paths),
            },
            next_states: Vec::with_capacity(paths),
            next_rays: Vec::with_capacity(paths),
        }
    }

    /// Starts `rays` paths at the camera.
    pub fn start(&mut self, rays: usize) {
        let new = self.first.len()..rays;
        self.first.extend(new.map(|sample| Path {
            beta: Spectrum::WHITE,
            p: Vec3::ZERO,
            pdf: f32::INFINITY,
            eta_scale: 1.0,
            sample: sample as u32,
        }));
    }

    /// Moves to the next depth: intersects the next rays, and returns their number.
    pub fn trace(&mut self, scene: &Scene) -> u64 {
        std::mem::swap(&mut self.states, &mut self.next_states);
        std::mem::swap(&mut self.rays, &mut self.next_rays);
        self.next_states.clear();
        self.next_rays.clear();
        // The previous contents are overwritten.
        self.hits.resize(self.rays.len(), Hit::MISS);
        scene.accel().intersect(&self.rays, &mut self.hits);
        self.rays.len() as u64
    }
}

/// Indices of paths, partitioned by what their rays hit.
#[derive(Default)]
pub struct PathsByHit {
    /// Paths whose rays hit a surface, flat Lambertian surfaces first: see [`Scene::flat_lambertian`].
    pub active: Vec<u32>,
    /// Number of elements of `active` that are on flat Lambertian surfaces.
    pub flat: usize,
    /// Paths whose rays hit nothing.
    pub escaped: Vec<u32>,
    /// Buffer for paths on all other surfaces.
    others: Vec<u32>,
}

impl PathsByHit {
    /// Partitions all paths by their hits.
    #[inline(never)]
    pub fn partition(&mut self, scene: &Scene, hits: &[Hit]) {
        let Self { active, others, escaped, .. } = self;
        active.resize(hits.len(), 0);
        escaped.resize(hits.len(), 0);
        // Branch-free: each index is written to both lists, and only one list grows. A branch would be
        // mispredicted often.
        let mut found = 0;
        for (i, hit) in (0..).zip(hits) {
            active[found] = i;
            escaped[i as usize - found] = i;
            found += usize::from(hit.is_hit());
        }
        active.truncate(found);
        escaped.truncate(hits.len() - found);
        self.flat = found;
        if !scene.is_flat_lambertian() {
            others.clear();
            others.extend(
                active.iter().filter(|&&i| scene.flat_lambertian(&hits[i as usize]).is_none()),
            );
            active.retain(|&i| scene.flat_lambertian(&hits[i as usize]).is_some());
            self.flat = active.len();
            active.extend_from_slice(others);
        }
    }
}

impl Path {
    /// Russian roulette with `u` in `[0, 1)`: whether the path continues. If so, its beta is divided by the
    /// probability of that (PBRT 3rd edition, section 14.5.4).
    #[inline]
    pub fn survives(&mut self, u: f32) -> bool {
        let survival = (self.beta * self.eta_scale).max_component().min(1.0);
        if u >= survival {
            return false;
        }
        self.beta = self.beta / survival;
        true
    }
}
