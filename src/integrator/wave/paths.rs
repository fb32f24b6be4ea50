//! [`Paths`]: the paths of a wave, and the buffers of the stages that they go through.

use glam::{Vec2, Vec3};

use crate::accel::Hit;
use crate::geometry::Ray;
use crate::sampling::SampleId;
use crate::scene::Scene;
use crate::spectrum::Spectrum;

/// What is known of a path beside its ray.
#[derive(Clone, Copy)]
pub struct Path {
    /// β: path throughput divided by path density.
    pub beta: Spectrum,
    /// Where its ray begins, before the origin was moved off the surface. Nothing of use for a ray from the
    /// camera, which begins where it begins.
    pub p: Vec3,
    /// Density over solid angle of the ray's direction; infinite from the camera and from delta lobes.
    pub pdf: f32,
    /// How much radiance was squeezed by refraction on the way: eta² of all boundaries. It has no part in
    /// whether a path is worth to go on.
    pub eta_scale: f32,
    /// The sample's number in the wave.
    pub sample: u32,
}

/// Sample values of the paths that go on, each empty unless it is asked for.
#[derive(Default)]
pub struct Values {
    pub ids: Vec<SampleId>,
    pub direction: Vec<Vec2>,
    pub light: Vec<Vec2>,
    pub choice: Vec<f32>,
    pub roulette: Vec<f32>,
}

/// The paths of a wave. Element i of `states`, `rays` and `hits` belongs to the same path. Before the first
/// reflection `first` stands for the states, and rays and hits are those of the wave itself.
#[derive(Default)]
pub struct Paths {
    /// The states of paths that begin: alike in all waves.
    pub first: Vec<Path>,
    pub states: Vec<Path>,
    pub rays: Vec<Ray>,
    pub hits: Vec<Hit>,
    pub met: Met,
    pub values: Values,
    /// What becomes of `states` and `rays` after the reflection.
    pub next_states: Vec<Path>,
    pub next_rays: Vec<Ray>,
}

impl Paths {
    /// Room for so many paths.
    pub fn with_capacity(paths: usize) -> Self {
        Self {
            first: Vec::with_capacity(paths),
            states: Vec::with_capacity(paths + 1),
            rays: Vec::with_capacity(paths),
            hits: Vec::with_capacity(paths),
            met: Met {
                active: Vec::with_capacity(paths),
                plain: 0,
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

    /// Starts with so many camera rays.
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

    /// Finds what the next rays hit, and returns how many they are.
    pub fn trace(&mut self, scene: &Scene) -> u64 {
        std::mem::swap(&mut self.states, &mut self.next_states);
        std::mem::swap(&mut self.rays, &mut self.next_rays);
        self.next_states.clear();
        self.next_rays.clear();
        // What is left of other rays is overwritten.
        self.hits.resize(self.rays.len(), Hit::MISS);
        scene.accel().intersect(&self.rays, &mut self.hits);
        self.rays.len() as u64
    }
}

/// Places of paths, by what these have met.
#[derive(Default)]
pub struct Met {
    /// A surface, plain ones first: see [`Scene::plain`].
    pub active: Vec<u32>,
    /// How many of these are plain.
    pub plain: usize,
    /// Nothing.
    pub escaped: Vec<u32>,
    /// For those that are not plain.
    others: Vec<u32>,
}

impl Met {
    /// Sorts the paths by what they have met.
    #[inline(never)]
    pub fn sort(&mut self, scene: &Scene, hits: &[Hit]) {
        let Self { active, others, escaped, .. } = self;
        active.resize(hits.len(), 0);
        escaped.resize(hits.len(), 0);
        // Each is written to both, and counted where it belongs: a branch would be hard to foresee.
        let mut found = 0;
        for ((place, hit), number) in hits.iter().enumerate().zip(0..) {
            active[found] = number;
            escaped[place - found] = number;
            found += usize::from(hit.is_hit());
        }
        active.truncate(found);
        escaped.truncate(hits.len() - found);
        self.plain = found;
        if !scene.is_plain() {
            others.clear();
            others.extend(
                active.iter().filter(|&&place| scene.plain(&hits[place as usize]).is_none()),
            );
            active.retain(|&place| scene.plain(&hits[place as usize]).is_some());
            self.plain = active.len();
            active.extend_from_slice(others);
        }
    }
}

impl Path {
    /// Lets the path end at random, the likelier the less it carries, and its beta make up for it if it does not
    /// (PBRT 3rd edition, section 14.5.4). `u` in `[0, 1)`.
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
