//! [`Vertices`]: the stage that turns the hits of a wave into shadow rays and next rays.

use glam::{Vec2, Vec4};

use super::compact::push_x4;
use super::dimension;
use super::flat::{BLOCK, FlatHits};
use super::flat_lights::LightSamples;
use super::paths::{Path, Values};
use super::rules::PathRules;
use super::shadow_rays::ShadowRays;
use crate::bxdf::Arena;
use crate::geometry::Ray;
use crate::geometry::four::{Vec3x4, four, rays_x4};
use crate::light::LightSamplesX4;
use crate::sampling::Sampler;
use crate::scene::Scene;
use crate::spectrum::Spectrum;

/// The path vertices of a wave at one depth: the inputs and outputs of that stage. `turn` is the index of a
/// vertex among the active paths, by which `values` are ordered.
pub struct Vertices<'a> {
    pub rules: &'a PathRules,
    pub scene: &'a Scene,
    pub sampler: &'a dyn Sampler,
    pub values: &'a Values,
    pub depth: u32,
    pub arena: &'a Arena,
    pub shadow: &'a mut ShadowRays,
    pub next_states: &'a mut Vec<Path>,
    pub next_rays: &'a mut Vec<Ray>,
    pub rejected: u64,
}

impl Vertices<'_> {
    /// The light that a vertex samples in this slot, and the sample value for a point on it.
    #[inline]
    pub fn drawn(&self, slot: usize, turn: usize) -> (usize, Vec2) {
        let Self { rules, values, .. } = self;
        let choice = if rules.lights.draws() { values.choice[turn] } else { 0.0 };
        (rules.lights.pick(slot, choice), self.place(slot, turn))
    }

    /// The sample value for a point on the light of this slot.
    #[inline]
    fn place(&self, slot: usize, turn: usize) -> Vec2 {
        let Self { rules, values, sampler, .. } = self;
        if !rules.has_places {
            Vec2::ZERO
        } else if slot == 0 {
            values.light[turn]
        } else {
            sampler.get_2d(values.ids[turn], dimension::MORE_LIGHTS + slot as u32 - 1)
        }
    }

    /// Samples lights and next rays for a block of flat Lambertian hits that starts at `turn`. Hits that are
    /// not `sound` are left to the caller.
    #[inline(always)]
    pub fn scatter_flat(&mut self, turn: usize, block: &[FlatHits]) {
        for slot in 0..self.rules.lights.slots() {
            self.sample_lights(slot, turn, block);
        }
        if self.rules.goes_on(self.depth) {
            for (i, hits) in block.iter().enumerate().filter(|(_, hits)| hits.sound) {
                self.step(turn + 4 * i, hits);
            }
        }
    }

    /// Pushes shadow rays to the light of a slot, or to the light that each hit has drawn.
    #[inline(always)]
    fn sample_lights(&mut self, slot: usize, turn: usize, block: &[FlatHits]) {
        let Self { rules, scene, .. } = *self;
        if rules.lights.draws() {
            for (i, hits) in block.iter().enumerate().filter(|(_, hits)| hits.sound) {
                let drawn = four(|lane| self.drawn(slot, turn + 4 * i + lane));
                self.send(hits, &LightSamples::of_any(rules, scene, hits.at.p, drawn));
            }
            return;
        }
        const FOURS: usize = BLOCK / 4;
        let light = rules.lights.pick(slot, 0.0);
        let mut points = [Vec3x4::ZERO; FOURS];
        let mut u = [[Vec2::ZERO; 4]; FOURS];
        let mut samples = [LightSamplesX4::NONE; FOURS];
        for (i, hits) in block.iter().enumerate() {
            points[i] = hits.at.p;
            u[i] = four(|lane| self.place(slot, turn + 4 * i + lane));
        }
        let count = block.len();
        scene.lights()[light].sample_li_x4(&points[..count], &u[..count], &mut samples[..count]);
        for (hits, samples) in block.iter().zip(&samples).filter(|(hits, _)| hits.sound) {
            self.send(hits, &LightSamples::new(rules, light, *samples));
        }
    }

    /// Pushes shadow rays for light samples that are reflected.
    #[inline(always)]
    fn send(&mut self, hits: &FlatHits, lights: &LightSamples) {
        if let Some((mask, rays, carried)) = lights.reflected(hits) {
            self.shadow.push_x4(mask, hits.paths, &rays, &carried);
        }
    }

    /// Samples the next rays of four hits.
    #[inline(always)]
    fn step(&mut self, turn: usize, hits: &FlatHits) {
        let Self { rules, scene, values, depth, .. } = *self;
        let u = four(|i| values.direction[turn + i]);
        let (mut mask, mut paths, wi) = hits.step(u);
        if rules.throws(depth) {
            for (i, path) in paths.iter_mut().enumerate() {
                mask &= !(u32::from(!path.survives(values.roulette[turn + i])) << i);
            }
        }
        let rays = rays_x4(hits.at.ray_origins(hits.n, wi), wi, Vec4::INFINITY);
        if rules.walks_on(depth) {
            push_x4(self.next_states, mask, &paths);
            push_x4(self.next_rays, mask, &rays);
            return;
        }
        let found = four(|i| {
            if mask >> i & 1 == 0 {
                return Spectrum::BLACK;
            }
            rules.escaped(scene, paths[i].p, rays[i].d, &paths[i])
        });
        for (i, found) in found.iter().enumerate() {
            mask &= !(u32::from(found.is_black()) << i);
        }
        self.shadow.push_x4(mask, hits.paths, &rays, &found);
    }
}
