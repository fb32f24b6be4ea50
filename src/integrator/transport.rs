//! [`Transport`]: light transport on waves, which all integrators share that know what light is.
//!
//! A wave goes through the same stages for each reflection: what the rays met of lights; sample values for
//! those that go on; light samples and new directions; shadow rays; the new rays. A stage that a scene has no
//! use for is left out: without lights that rays can meet nothing is looked for there, with one light none
//! is chosen, and where nothing is left to be found no direction is drawn.

use glam::{Vec2, Vec3};

use super::paths::{Path, Paths, Values, Vertex};
use super::wave::{ShadowRays, Wave, dimension};
use crate::Spectrum;
use crate::bxdf::{BxdfFlags, TransportMode};
use crate::light::{Light, LightHit, LightSample};
use crate::sampling::{Discrete, SampleId, Sampler};
use crate::scene::{LightStrategy, Scene};

/// Which lights are sampled at a hit.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum LightChoice {
    /// Each of them.
    All,
    /// One, in proportion to its power.
    ByPower,
}

/// Settings, and what follows from them and the scene's lights.
pub struct Transport {
    max_depth: u32,
    roulette: bool,
    draw: Draw,
    /// Whether a light that is sampled has an extent, and so asks for a place.
    has_places: bool,
    /// By light: how likely a hit samples it; 0 for one that is only found by rays.
    probability: Vec<f32>,
    /// By light: whether rays can meet it.
    visible: Vec<bool>,
    /// Lights that rays find which leave the scene.
    infinite: Vec<usize>,
    /// Whether there are lights that rays can meet on surfaces.
    on_surfaces: bool,
    /// Whether what a ray meets counts, other than through delta lobes and from the camera.
    finds: bool,
}

/// How the lights to be sampled are drawn at a hit.
enum Draw {
    /// All of these.
    Each(Vec<usize>),
    /// One of several.
    One(Vec<usize>, Discrete),
}

impl Draw {
    fn lights(&self) -> &[usize] {
        match self {
            Self::Each(lights) | Self::One(lights, _) => lights,
        }
    }
}

/// From which reflection on paths may end at random (PBRT 3rd edition, section 14.5.4).
const ROULETTE_FROM: u32 = 3;

impl Transport {
    pub fn new(
        scene: &Scene,
        max_depth: u32,
        roulette: bool,
        strategy: LightStrategy,
        choice: LightChoice,
    ) -> Self {
        let lights = scene.lights();
        let sphere = scene.bounding_sphere();
        let power = |light: &dyn Light| {
            let power = light.power(&sphere).to_array().iter().sum::<f32>();
            f64::from(power)
        };
        let mut visible: Vec<bool> = lights.iter().map(|light| light.is_infinite()).collect();
        scene.lights_on_surfaces().for_each(|i| visible[i] = true);
        let wanted = |i: &usize| match strategy {
            LightStrategy::Auto => !visible[*i] || lights[*i].is_worth_sampling(),
            LightStrategy::Mis | LightStrategy::Light => true,
            LightStrategy::Bsdf => !visible[*i],
        };
        let sampled: Vec<usize> = (0..lights.len()).filter(wanted).collect();
        let mut probability = vec![0.0; lights.len()];
        let draw = if choice == LightChoice::All || sampled.len() < 2 {
            sampled.iter().for_each(|&i| probability[i] = 1.0);
            Draw::Each(sampled)
        } else if let Some(by_power) = Discrete::new(sampled.iter().map(|&i| power(&*lights[i]))) {
            for (place, &i) in sampled.iter().enumerate() {
                probability[i] = by_power.probability(place);
            }
            Draw::One(sampled, by_power)
        } else {
            // All of them are dark.
            Draw::Each(Vec::new())
        };
        let has_extent = |i: &usize| !lights[*i].is_delta();
        let infinite: Vec<_> = (0..lights.len()).filter(|&i| lights[i].is_infinite()).collect();
        Self {
            max_depth,
            roulette,
            has_places: draw.lights().iter().any(has_extent),
            draw,
            probability,
            visible,
            on_surfaces: scene.lights_on_surfaces().next().is_some(),
            infinite,
            finds: strategy != LightStrategy::Light,
        }
    }

    /// Adds what arrives along each ray of the wave.
    pub fn shade(&self, scene: &Scene, sampler: &dyn Sampler, wave: &mut Wave) {
        wave.paths.start(&wave.rays, &wave.hits);
        for depth in 0..=self.max_depth {
            self.meet(scene, &mut wave.paths, &mut wave.radiance);
            if depth == self.max_depth || wave.paths.active.is_empty() {
                break;
            }
            self.draw_samples(sampler, &wave.ids, &mut wave.paths, depth);
            self.scatter(scene, sampler, wave, depth);
            wave.counters.shadow_rays += wave.shadow.trace(scene, &mut wave.radiance);
            wave.counters.scattered_rays += wave.paths.trace(scene);
        }
    }

    /// Whether anything could be made of a ray that leaves a hit after so many reflections.
    #[inline]
    fn goes_on(&self, depth: u32) -> bool {
        depth + 1 < self.max_depth || self.on_surfaces || !self.infinite.is_empty()
    }

    /// Whether paths may end at random after so many reflections. The last ray of a path looks for lights
    /// alone: it is not worth a throw.
    #[inline]
    fn throws(&self, depth: u32) -> bool {
        self.roulette && depth >= ROULETTE_FROM && depth + 1 < self.max_depth
    }

    /// Adds the light that rays met, and notes which paths have a surface to go on from.
    #[inline(never)]
    fn meet(&self, scene: &Scene, paths: &mut Paths, radiance: &mut [Spectrum]) {
        let Paths { states, rays, hits, active, .. } = paths;
        active.clear();
        for (place, ((path, ray), hit)) in states.iter().zip(&*rays).zip(&*hits).enumerate() {
            if !hit.is_hit() {
                radiance[path.sample as usize] += self.escaped(scene, ray.d, path);
                continue;
            }
            active.push(place as u32);
            if self.on_surfaces
                && let Some(number) = scene.light_at(hit)
            {
                let n = scene.interaction(ray, hit).n();
                let at = LightHit { origin: path.p, wi: ray.d, distance: hit.t, n };
                radiance[path.sample as usize] += self.found(scene, number, &at, path);
            }
        }
    }

    /// What a path brings home that leaves the scene along `wi`.
    #[inline]
    fn escaped(&self, scene: &Scene, wi: Vec3, path: &Path) -> Spectrum {
        let at = LightHit { origin: path.p, wi, distance: f32::INFINITY, n: Vec3::ZERO };
        self.infinite.iter().map(|&number| self.found(scene, number, &at, path)).sum()
    }

    /// What a path brings home that ends at a light, weighed against the light's own samples.
    #[inline]
    fn found(&self, scene: &Scene, number: usize, at: &LightHit, path: &Path) -> Spectrum {
        let light = &*scene.lights()[number];
        let probability = self.probability[number];
        // The camera and delta lobes leave the light's own samples nothing.
        let weight = if path.pdf == f32::INFINITY || probability == 0.0 {
            1.0
        } else if self.finds {
            power_heuristic(path.pdf, probability * light.pdf_li(at))
        } else {
            return Spectrum::BLACK;
        };
        path.beta * light.le(at) * weight
    }

    /// Sample values for the paths that go on.
    #[inline(never)]
    fn draw_samples(&self, sampler: &dyn Sampler, ids: &[SampleId], paths: &mut Paths, depth: u32) {
        let Paths { states, active, values, .. } = paths;
        values.ids.clear();
        values.ids.extend(active.iter().map(|&place| ids[states[place as usize].sample as usize]));
        let first = dimension::of_depth(depth);
        if self.goes_on(depth) {
            sampler.fill_2d(&values.ids, first + dimension::DIRECTION, &mut values.direction);
        }
        if self.has_places {
            sampler.fill_2d(&values.ids, first + dimension::LIGHT, &mut values.light);
        }
        if let Draw::One(..) = self.draw {
            sampler.fill_1d(&values.ids, first + dimension::CHOICE, &mut values.choice);
        }
        if self.throws(depth) {
            sampler.fill_1d(&values.ids, first + dimension::ROULETTE, &mut values.roulette);
        }
    }

    /// Samples lights and new directions at the hits: shadow rays and the next rays.
    #[inline(never)]
    fn scatter(&self, scene: &Scene, sampler: &dyn Sampler, wave: &mut Wave, depth: u32) {
        let Wave { paths, shadow, arena, counters, .. } = wave;
        let Paths { states, rays, hits, active, values, next_states, next_rays } = paths;
        for (turn, place) in active.iter().map(|&place| place as usize).enumerate() {
            let (path, ray, hit) = (&states[place], &rays[place], &hits[place]);
            let mut si = scene.interaction(ray, hit);
            let material = scene.material(hit);
            let bsdf = material.compute_scattering(&mut si, arena, TransportMode::Radiance, true);
            let vertex = Vertex { path, si: &si, bsdf: &bsdf };
            self.sample_lights(scene, sampler, &vertex, values, turn, shadow);
            if self.goes_on(depth)
                && let Some((mut step, wi)) = vertex.step(values.direction[turn])
                && (!self.throws(depth) || step.survives(values.roulette[turn]))
            {
                if depth + 1 < self.max_depth || self.on_surfaces {
                    next_states.push(step);
                    next_rays.push(si.spawn_ray(wi));
                } else {
                    // All that is left to be found surrounds the scene: whether anything stands before it
                    // is a question for a shadow ray.
                    let found = self.escaped(scene, wi, &step);
                    if !found.is_black() {
                        shadow.push(step.sample as usize, si.spawn_ray(wi), found);
                    }
                }
            }
            counters.rejected += u64::from(bsdf.rejected());
        }
        arena.reset();
    }

    /// Sends shadow rays from a hit to the lights that are to be sampled there.
    #[inline]
    fn sample_lights(
        &self,
        scene: &Scene,
        sampler: &dyn Sampler,
        vertex: &Vertex,
        values: &Values,
        turn: usize,
        shadow: &mut ShadowRays,
    ) {
        let u = if self.has_places { values.light[turn] } else { Vec2::ZERO };
        match &self.draw {
            Draw::Each(lights) => {
                let Some((&first, others)) = lights.split_first() else { return };
                self.sample_light(scene, vertex, first, u, shadow);
                for (&number, i) in others.iter().zip(0..) {
                    let u = if self.has_places {
                        sampler.get_2d(values.ids[turn], dimension::MORE_LIGHTS + i)
                    } else {
                        Vec2::ZERO
                    };
                    self.sample_light(scene, vertex, number, u, shadow);
                }
            }
            Draw::One(lights, by_power) => {
                let (place, ..) = by_power.sample(values.choice[turn]);
                self.sample_light(scene, vertex, lights[place], u, shadow);
            }
        }
    }

    /// Sends a shadow ray from a hit to a light, weighed against finding the light by reflection.
    #[inline]
    fn sample_light(
        &self,
        scene: &Scene,
        vertex: &Vertex,
        number: usize,
        u: Vec2,
        shadow: &mut ShadowRays,
    ) {
        let Vertex { path, si, bsdf } = vertex;
        let light = &*scene.lights()[number];
        let Some(LightSample { li, wi, pdf, from }) = light.sample_li(si.p(), u) else { return };
        let pdf = pdf * self.probability[number];
        let (f, weight) = if self.finds && self.visible[number] {
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
        shadow.push(path.sample as usize, ray, carried);
    }
}

/// The weight of a sample drawn with density `a` where another way to draw it has density `b`
/// (Veach 1997, section 9.2.4, with exponent 2).
#[inline]
fn power_heuristic(a: f32, b: f32) -> f32 {
    // By the ratio: squares of densities leave the range of f32.
    let ratio = b / a;
    1.0 / (1.0 + ratio * ratio)
}
