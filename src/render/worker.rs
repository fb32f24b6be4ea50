//! [`Worker`]: one thread's share of the rendering.

use std::ops::Range;

use glam::UVec2;

use super::RenderOptions;
use super::samples::Samples;
use crate::bxdf::{BxdfFlags, TransportMode};
use crate::film::{Film, FilmContents, FilmError};
use crate::image::Window;
use crate::integrator::{Counters, Integrator, Wave};
use crate::sampling::{SampleId, Sampler};
use crate::scene::Scene;

/// How many samples go through the integrator together: enough for batches to pay, few enough for
/// rays and hits to stay in the second-level cache.
const WAVE: usize = 1024;

/// Points for reflectances that have no closed form: a lattice over the unit square.
const RHO_POINTS: usize = 16;

/// Renders tiles. All of its memory is taken when it is made, apart from that of foreign lobes: the arena
/// grows until it has met the hit that needs most.
pub struct Worker<'a> {
    scene: &'a Scene,
    integrator: &'a dyn Integrator,
    sampler: &'a dyn Sampler,
    wave: Wave,
    tile: Film,
    sets: u32,
    rho_points: [glam::Vec2; RHO_POINTS],
}

impl<'a> Worker<'a> {
    /// A worker with room for the largest tile.
    pub fn new(
        scene: &'a Scene,
        integrator: &'a dyn Integrator,
        sampler: &'a dyn Sampler,
        options: &RenderOptions,
        sets: u32,
        contents: FilmContents,
    ) -> Result<Self, FilmError> {
        let film = scene.film();
        let size = film.window().size().min(UVec2::splat(options.tile_size.max(1)));
        let largest = Window { min: UVec2::ZERO, max: size };
        let tile = Film::new(film.resolution, largest, contents)?;
        Ok(Self {
            scene,
            integrator,
            sampler,
            wave: Wave::with_capacity(WAVE, integrator.shadow_rays()),
            tile,
            sets,
            rho_points: lattice(),
        })
    }

    /// Renders the samples whose indices are in `pass`, of each set of each pixel of a tile, wave by wave. Those of a
    /// pixel are added in the order of set and index, so that its sum does not depend on how the image is cut.
    pub fn render(&mut self, window: Window, pass: &Range<u32>) {
        self.tile.reset(window);
        let mut samples = Samples::new(window, self.sets, pass.clone());
        while !samples.is_empty() {
            samples.fill(WAVE, &mut self.wave.ids);
            self.wave.begin(self.scene, self.sampler);
            self.integrator.shade(self.scene, self.sampler, &mut self.wave);
            self.add_samples();
            if self.tile.has_layers() {
                self.add_first_hits();
            }
        }
    }

    fn add_samples(&mut self) {
        let mut radiance = &self.wave.radiance[..];
        for of_set in SampleId::sets(&self.wave.ids) {
            let (samples, rest) = radiance.split_at(of_set.len());
            self.tile.add_samples(of_set[0].pixel, of_set[0].set, samples);
            radiance = rest;
        }
    }

    /// The tile that was rendered last.
    pub fn tile(&self) -> &Film {
        &self.tile
    }

    /// What was done since the last time this was asked.
    pub fn take_counters(&mut self) -> Counters {
        std::mem::take(&mut self.wave.counters)
    }

    /// Normal, depth and albedo of what the camera rays hit. It shades every hit once more, which
    /// only a render with layers pays for.
    fn add_first_hits(&mut self) {
        let wave = &mut self.wave;
        for ((id, ray), hit) in wave.ids.iter().zip(&wave.rays).zip(&wave.hits) {
            if !hit.is_hit() {
                continue;
            }
            let mut si = self.scene.interaction(ray, hit);
            let material = self.scene.material(hit);
            let bsdf =
                material.compute_scattering(&mut si, &wave.arena, TransportMode::Radiance, true);
            let albedo = bsdf.rho_hd(si.wo(), &self.rho_points, BxdfFlags::all());
            wave.counters.rejected += u64::from(bsdf.rejected());
            self.tile.add_first_hit(id.pixel, si.shading_n(), hit.t, albedo);
        }
        wave.arena.reset();
    }
}

/// A rank-1 lattice with the golden ratio as its step.
fn lattice() -> [glam::Vec2; RHO_POINTS] {
    std::array::from_fn(|i| {
        let x = (i as f32 + 0.5) / RHO_POINTS as f32;
        glam::Vec2::new(x, (i as f32 * 0.618_034).fract())
    })
}
