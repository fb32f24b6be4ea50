//! [`Vertices`]: the stage of a wave that turns hits into shadow rays and next rays.

use glam::{Vec2, Vec4};

use super::paths::{Path, Values};
use super::plain::{BLOCK, PlainHits, push_x4};
use super::plain_lights::LightSamples;
use super::rules::PathRules;
use super::{ShadowRays, dimension};
use crate::bxdf::Arena;
use crate::geometry::Ray;
use crate::geometry::four::{Vec3x4, four, rays_x4};
use crate::light::LightSamplesX4;
use crate::sampling::Sampler;
use crate::scene::Scene;
use crate::spectrum::Spectrum;

/// The vertices of a wave's paths after the same number of reflections: what is known of them, and what comes
/// of them. The place of a path among them is its turn.
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
    /// Which light is asked in one of the vertex's slots, and the place on it.
    #[inline]
    pub fn drawn(&self, slot: usize, turn: usize) -> (usize, Vec2) {
        let Self { rules, values, .. } = self;
        let choice = if rules.lights.draws() { values.choice[turn] } else { 0.0 };
        (rules.lights.pick(slot, choice), self.place(slot, turn))
    }

    /// The place on the light that is asked in one of the vertex's slots.
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

    /// Light samples and next rays of up to a block of plain hits, of which the first has this turn. Those that
    /// are not sound are left to the caller.
    #[inline(always)]
    pub fn scatter_plain(&mut self, turn: usize, block: &[PlainHits]) {
        for slot in 0..self.rules.lights.slots() {
            self.sample_lights(slot, turn, block);
        }
        if self.rules.goes_on(self.depth) {
            for (i, hits) in block.iter().enumerate().filter(|(_, hits)| hits.sound) {
                self.step(turn + 4 * i, hits);
            }
        }
    }

    /// Sends shadow rays from plain hits to the light of a slot, or from each to the light that it drew.
    #[inline(always)]
    fn sample_lights(&mut self, slot: usize, turn: usize, block: &[PlainHits]) {
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

    /// Sends shadow rays to where light comes from.
    #[inline(always)]
    fn send(&mut self, hits: &PlainHits, lights: &LightSamples) {
        if let Some((mask, rays, carried)) = lights.reflected(hits) {
            self.shadow.push_x4(mask, hits.paths, &rays, &carried);
        }
    }

    /// The next rays of four plain hits.
    #[inline(always)]
    fn step(&mut self, turn: usize, hits: &PlainHits) {
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
