//! [`Worker`]: one thread's share of the rendering.

use glam::UVec2;

use super::options::RenderError;
use super::pass::Pass;
use super::samples::Samples;
use crate::bxdf::BxdfFlags;
use crate::film::Film;
use crate::image::Window;
use crate::integrator::{Counters, Wave, dimension};
use crate::sampling::SampleId;

/// How many samples go through the integrator together: enough for batches to pay, few enough for
/// rays and hits to stay in the second-level cache. In scenes of many materials more, so that blocks of one material are full.
const fn wave(materials: usize) -> usize {
    if materials > 8 { 4096 } else { 1024 }
}

/// Renders tiles. It allocates when it is made and not afterwards, except that the arena for lobes of other crates
/// grows until it has met the hit that needs most.
pub struct Worker<'a> {
    pass: &'a Pass<'a>,
    /// Of a wave.
    samples: usize,
    wave: Wave<'a>,
    /// How many samples of the wave in a row are of one set.
    runs: Vec<usize>,
    tile: Film,
}

impl<'a> Worker<'a> {
    /// A worker with room for the largest tile. `cancelled` tells when it is to stop.
    pub fn new(
        pass: &'a Pass<'a>,
        cancelled: &'a (dyn Fn() -> bool + Sync),
    ) -> Result<Self, RenderError> {
        let film = pass.view.film();
        let size = film.window().size().min(UVec2::splat(pass.options.tile_size.max(1)));
        let largest = Window { min: UVec2::ZERO, max: size };
        let tile = Film::new(film.resolution, largest, pass.contents)?;
        let shadow_rays = pass.estimator.shadow_rays();
        let materials = pass.scene.material_count();
        let samples = wave(materials);
        let bytes = Wave::bytes(samples, shadow_rays, materials);
        if !is_available(bytes) {
            return Err(RenderError::OutOfMemory(bytes as u64));
        }
        let wave = Wave::with_capacity(samples, shadow_rays, materials, cancelled);
        Ok(Self { pass, samples, wave, runs: Vec::with_capacity(samples), tile })
    }

    /// Renders the samples of the pass in a tile, wave by wave, and returns whether it took them all: once the render is
    /// cancelled it stops, before the next wave or at a wave's next reflection. The samples of a pixel are added in the
    /// order of set and index, so that its sum does not depend on how the image is cut.
    pub fn render(&mut self, window: Window) -> bool {
        let Pass { scene, view, estimator, sampler, sets, ref samples, .. } = *self.pass;
        self.tile.reset(window);
        let mut samples = Samples::new(window, sets, samples.clone());
        while !samples.is_empty() {
            if self.wave.is_cancelled() {
                return false;
            }
            samples.fill(self.samples, &mut self.wave.ids, &mut self.runs);
            self.wave.begin(scene, view, sampler);
            estimator.shade(sampler, &mut self.wave);
            if self.wave.is_cut() {
                return false;
            }
            self.add_samples();
            if self.tile.has_layers() {
                self.add_first_hits();
            }
        }
        true
    }

    fn add_samples(&mut self) {
        let mut start = 0;
        for run in &self.runs {
            let SampleId { pixel, set, .. } = self.wave.ids[start];
            self.tile.add_samples(pixel, set, &self.wave.radiance[start..][..*run]);
            start += run;
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

    /// Adds normal, depth and albedo of what the camera rays hit. It shades every hit once more, which
    /// only a render with layers pays for. An albedo without closed form is estimated by one direction of each sample.
    fn add_first_hits(&mut self) {
        let (&Pass { scene, sampler, .. }, wave) = (self.pass, &mut self.wave);
        for ((id, ray), hit) in wave.ids.iter().zip(&wave.rays).zip(&wave.hits) {
            if !hit.is_hit() {
                continue;
            }
            let mut si = scene.seen(ray, hit, wave.cone.as_ref());
            let bsdf = scene.bsdf(hit, &mut si, &wave.arena);
            let uc = sampler.get_1d(*id, dimension::ALBEDO_EVENT);
            let u = sampler.get_2d(*id, dimension::ALBEDO);
            let albedo = bsdf.rho_hd(si.wo(), &[uc], &[u], BxdfFlags::all());
            wave.counters.rejected += u64::from(bsdf.rejected());
            self.tile.add_first_hit(id.pixel, bsdf.frame().n, hit.t, albedo);
        }
        wave.arena.reset();
    }
}

/// Whether this number of bytes could be allocated.
pub fn is_available(bytes: usize) -> bool {
    Vec::<u8>::new().try_reserve_exact(bytes).is_ok()
}
