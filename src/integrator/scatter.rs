//! [`Scatter`]: light samples and new directions at the hits of a wave.

use arrayvec::ArrayVec;
use glam::{Vec2, Vec4};

use super::paths::{Path, Paths, Values, Vertex};
use super::plain::{BLOCK, Fetched, PlainHits, push_x4};
use super::plain_lights::LightSamples;
use super::transport::{Draw, Transport, power_heuristic};
use super::wave::{ShadowRays, Wave, dimension};
use crate::accel::Hit;
use crate::bxdf::{Arena, BxdfFlags, TransportMode};
use crate::geometry::Ray;
use crate::geometry::four::{four, rays_x4};
use crate::light::{KnownLight, LightSample};
use crate::sampling::Sampler;
use crate::scene::Scene;
use crate::spectrum::Spectrum;

/// One such stage.
pub struct Scatter<'a> {
    transport: &'a Transport,
    scene: &'a Scene,
    sampler: &'a dyn Sampler,
    values: &'a Values,
    depth: u32,
    shadow: &'a mut ShadowRays,
    next_states: &'a mut Vec<Path>,
    next_rays: &'a mut Vec<Ray>,
    rejected: u64,
}

impl Transport {
    /// Samples lights and new directions at the hits: shadow rays and the next rays.
    #[inline(never)]
    pub(super) fn scatter(
        &self,
        scene: &Scene,
        sampler: &dyn Sampler,
        wave: &mut Wave,
        depth: u32,
    ) {
        let Wave { rays, hits, paths, shadow, arena, counters, .. } = wave;
        let Paths { first, states, met, values, next_states, next_rays, .. } = paths;
        let states = if depth == 0 { first } else { states };
        let (rays, hits) = if depth == 0 { (&*rays, &*hits) } else { (&paths.rays, &paths.hits) };
        let mut scatter = Scatter {
            transport: self,
            scene,
            sampler,
            values,
            depth,
            shadow,
            next_states,
            next_rays,
            rejected: 0,
        };
        let at = |place: u32| {
            let place = place as usize;
            (&states[place], &rays[place], &hits[place])
        };
        let mut fetched = Fetched::new();
        let mut plain = ArrayVec::<_, { BLOCK / 4 }>::new();
        let (fours, _) = met.active[..met.plain].as_chunks::<4>();
        for (block, fours) in fours.chunks(BLOCK / 4).enumerate() {
            // In three short loops, so that the processor sees several turns of each at a time.
            for (i, &place) in fours.as_flattened().iter().enumerate() {
                let (_, ray, hit) = at(place);
                fetched.set(i, scene, ray, hit);
            }
            plain.clear();
            for (i, places) in fours.iter().enumerate() {
                plain.push(PlainHits::new(&fetched, i, four(|i| at(places[i]).0)));
            }
            for (i, (plain, places)) in plain.iter().zip(fours).enumerate() {
                let turn = BLOCK * block + 4 * i;
                if plain.sound {
                    scatter.four(turn, plain);
                } else {
                    for (turn, &place) in (turn..).zip(places) {
                        scatter.one(turn, at(place), arena);
                    }
                }
            }
        }
        for (turn, &place) in met.active.iter().enumerate().skip(4 * fours.len()) {
            scatter.one(turn, at(place), arena);
        }
        counters.rejected += scatter.rejected;
        arena.reset();
    }
}

impl Scatter<'_> {
    /// A hit of any kind.
    #[inline(never)]
    fn one(&mut self, turn: usize, (path, ray, hit): (&Path, &Ray, &Hit), arena: &Arena) {
        let Self { transport, scene, values, depth, .. } = *self;
        let mut si = scene.interaction(ray, hit);
        let material = scene.material(hit);
        let bsdf = material.compute_scattering(&mut si, arena, TransportMode::Radiance, true);
        let vertex = Vertex { path, si: &si, bsdf: &bsdf };
        for slot in 0..transport.slots() {
            let (number, u) = self.drawn(slot, turn);
            self.sample_light(&vertex, number, u);
        }
        if transport.goes_on(depth)
            && let Some((mut step, wi)) = vertex.step(values.direction[turn])
            && (!transport.throws(depth) || step.survives(values.roulette[turn]))
        {
            if transport.walks_on(depth) {
                self.next_states.push(step);
                self.next_rays.push(si.spawn_ray(wi));
            } else {
                // All that is left to be found surrounds the scene: whether anything stands before it
                // is a question for a shadow ray.
                let found = transport.escaped(scene, step.p, wi, &step);
                if !found.is_black() {
                    self.shadow.push(step.sample as usize, si.spawn_ray(wi), found);
                }
            }
        }
        self.rejected += u64::from(bsdf.rejected());
    }

    /// Which light is asked in one of the hit's slots, and the place on it.
    #[inline]
    fn drawn(&self, slot: usize, turn: usize) -> (usize, Vec2) {
        let Self { transport, values, sampler, .. } = self;
        let u = if !transport.has_places {
            Vec2::ZERO
        } else if slot == 0 {
            values.light[turn]
        } else {
            sampler.get_2d(values.ids[turn], dimension::MORE_LIGHTS + slot as u32 - 1)
        };
        let number = match &transport.draw {
            Draw::Each(lights) => lights[slot],
            Draw::One(lights, by_power) => lights[by_power.sample(values.choice[turn]).0],
        };
        (number, u)
    }

    /// Sends a shadow ray from a hit to a light, weighed against finding the light by reflection.
    #[inline]
    fn sample_light(&mut self, vertex: &Vertex, number: usize, u: Vec2) {
        let Vertex { path, si, bsdf } = vertex;
        let light = &*self.scene.lights()[number];
        let Some(LightSample { li, wi, pdf, from }) = light.sample_li(si.p(), u) else { return };
        let pdf = pdf * self.transport.probability[number];
        let (f, weight) = if self.transport.finds && self.transport.visible[number] {
            let (f, scattering_pdf) = bsdf.f_and_pdf(si.wo(), wi, BxdfFlags::all());
            (f, power_heuristic(pdf, scattering_pdf))
        } else {
            (bsdf.f(si.wo(), wi, BxdfFlags::all()), 1.0)
        };
        // Light that will not be reflected need not be asked for.
        if f.is_black() {
            return;
        }
        let cos_theta = wi.dot(si.shading_n()).abs();
        let carried = path.beta * f * li * (cos_theta * weight / pdf);
        let ray = from.map_or_else(|| si.spawn_ray(wi), |from| si.spawn_ray_to(from));
        self.shadow.push(path.sample as usize, ray, carried);
    }

    /// Sends shadow rays from four plain hits to the light of a slot, or from each to the light that it drew. `send` is
    /// compiled for each kind apart: one match behind it took 4.7 % more instructions.
    #[inline(always)]
    fn four_to_light(&mut self, slot: usize, turn: usize, hits: &PlainHits) {
        let Self { transport, scene, .. } = *self;
        let p = hits.at.p;
        if let Draw::Each(lights) = &transport.draw
            && let number = lights[slot]
            && let Some(light) = &scene.known_lights()[number]
        {
            let u = || four(|i| self.drawn(slot, turn + i).1);
            let new = |samples| LightSamples::new(transport, number, samples);
            match light {
                KnownLight::Point(light) => return self.send(hits, &new(light.sample_x4(p))),
                KnownLight::Sky(light) => return self.send(hits, &new(light.sample_x4(u()))),
                KnownLight::Rectangle(light) => {
                    if let Some(samples) = light.sample_x4(p, u()) {
                        return self.send(hits, &new(samples));
                    }
                }
            }
        }
        let drawn = four(|i| self.drawn(slot, turn + i));
        self.send(hits, &LightSamples::of_any(transport, scene, p, drawn));
    }

    /// Sends shadow rays to where light comes from.
    #[inline(always)]
    fn send(&mut self, hits: &PlainHits, lights: &LightSamples) {
        if let Some((mask, rays, carried)) = lights.reflected(hits) {
            self.shadow.push_x4(mask, hits.paths, &rays, &carried);
        }
    }

    /// Four plain hits.
    #[inline(always)]
    fn four(&mut self, turn: usize, hits: &PlainHits) {
        let Self { transport, scene, values, depth, .. } = *self;
        for slot in 0..transport.slots() {
            self.four_to_light(slot, turn, hits);
        }
        if !transport.goes_on(depth) {
            return;
        }
        let u = four(|i| values.direction[turn + i]);
        let (mut mask, mut paths, wi) = hits.step(u);
        if transport.throws(depth) {
            for (i, path) in paths.iter_mut().enumerate() {
                mask &= !(u32::from(!path.survives(values.roulette[turn + i])) << i);
            }
        }
        let rays = rays_x4(hits.at.ray_origins(hits.n, wi), wi, Vec4::INFINITY);
        if transport.walks_on(depth) {
            push_x4(self.next_states, mask, &paths);
            push_x4(self.next_rays, mask, &rays);
            return;
        }
        let found = four(|i| {
            if mask >> i & 1 == 0 {
                return Spectrum::BLACK;
            }
            transport.escaped(scene, paths[i].p, rays[i].d, &paths[i])
        });
        for (i, found) in found.iter().enumerate() {
            mask &= !(u32::from(found.is_black()) << i);
        }
        self.shadow.push_x4(mask, hits.paths, &rays, &found);
    }
}
