//! [`Vertices`]: the stage that samples shadow rays and next rays at the hits of a wave.

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

/// The path vertices of a wave at one depth, with the inputs and outputs of this stage. A `vertex` is an index
/// into the active paths; `values` are in the same order.
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
    /// Index of the light that a vertex samples in this slot, and the sample value for a point on it.
    #[inline]
    pub fn choose_light(&self, slot: usize, vertex: usize) -> (usize, Vec2) {
        let Self { rules, values, .. } = self;
        let choice = if rules.lights.draws() { values.choice[vertex] } else { 0.0 };
        (rules.lights.pick(slot, choice), self.light_u(slot, vertex))
    }

    /// The sample value for a point on the light of this slot.
    #[inline]
    fn light_u(&self, slot: usize, vertex: usize) -> Vec2 {
        let Self { rules, values, sampler, .. } = self;
        if !rules.needs_light_u {
            Vec2::ZERO
        } else if slot == 0 {
            values.light[vertex]
        } else {
            sampler.get_2d(values.ids[vertex], dimension::MORE_LIGHTS + slot as u32 - 1)
        }
    }

    /// Samples lights and next rays for a block of flat Lambertian hits that starts at `vertex`. Hits that are not
    /// `sound` are left to the caller.
    #[inline(always)]
    pub fn scatter_flat(&mut self, vertex: usize, block: &[FlatHits]) {
        for slot in 0..self.rules.lights.slots() {
            self.sample_lights(slot, vertex, block);
        }
        if self.rules.contributes(self.depth, false) {
            for (i, hits) in block.iter().enumerate().filter(|(_, hits)| hits.sound) {
                self.sample_directions(vertex + 4 * i, hits);
            }
        }
    }

    /// Pushes shadow rays to the light of a slot, or to the light that each hit selects.
    #[inline(always)]
    fn sample_lights(&mut self, slot: usize, vertex: usize, block: &[FlatHits]) {
        let Self { rules, scene, .. } = *self;
        if rules.lights.draws() {
            for (i, hits) in block.iter().enumerate().filter(|(_, hits)| hits.sound) {
                let drawn = four(|lane| self.choose_light(slot, vertex + 4 * i + lane));
                self.push_shadow_rays(
                    hits,
                    &LightSamples::of_drawn(rules, scene, hits.at.p, drawn),
                );
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
            u[i] = four(|lane| self.light_u(slot, vertex + 4 * i + lane));
        }
        let count = block.len();
        scene.lights()[light].sample_li_x4(&points[..count], &u[..count], &mut samples[..count]);
        for (hits, samples) in block.iter().zip(&samples).filter(|(hits, _)| hits.sound) {
            self.push_shadow_rays(hits, &LightSamples::of_one(rules, light, *samples));
        }
    }

    /// Pushes shadow rays for those light samples that the surfaces reflect.
    #[inline(always)]
    fn push_shadow_rays(&mut self, hits: &FlatHits, lights: &LightSamples) {
        if let Some((mask, rays, carried)) = lights.reflected(hits) {
            self.shadow.push_x4(mask, hits.paths, &rays, &carried);
        }
    }

    /// Samples the next rays of four hits.
    #[inline(always)]
    fn sample_directions(&mut self, vertex: usize, hits: &FlatHits) {
        let Self { rules, scene, values, depth, .. } = *self;
        let u = four(|i| values.direction[vertex + i]);
        let (mut mask, mut paths, wi) = hits.sample_directions(u);
        if rules.uses_roulette(depth) {
            for (i, path) in paths.iter_mut().enumerate() {
                mask &= !(u32::from(!path.survives(values.roulette[vertex + i])) << i);
            }
        }
        let rays = rays_x4(hits.at.ray_origins(hits.n, wi), wi, Vec4::INFINITY);
        if rules.extends_path(depth) {
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
