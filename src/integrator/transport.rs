//! [`Transport`]: light transport on waves, which all integrators share that know what light is.
//!
//! A wave goes through the same stages for each reflection: what the rays met of lights; sample values for
//! those that go on; light samples and new directions; shadow rays; the new rays. A stage that a scene has no
//! use for is left out: without lights that rays can meet nothing is looked for there, with one light none
//! is chosen, and where nothing is left to be found no direction is drawn.

use glam::Vec3;

use super::paths::{Path, Paths};
use super::wave::{Wave, dimension};
use crate::light::LightHit;
use crate::sampling::{Discrete, SampleId, Sampler};
use crate::scene::{LightStrategy, Scene};
use crate::spectrum::Spectrum;

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
    pub(super) draw: Draw,
    /// Whether a light that is sampled has an extent, and so asks for a place.
    pub(super) has_places: bool,
    /// By light: how likely a hit samples it; 0 for one that is only found by rays.
    pub(super) probability: Vec<f32>,
    /// By light: whether rays can meet it.
    pub(super) visible: Vec<bool>,
    /// Lights that rays find which leave the scene.
    infinite: Vec<usize>,
    /// Whether there are lights that rays can meet on surfaces.
    on_surfaces: bool,
    /// Whether what a ray meets counts, other than through delta lobes and from the camera.
    pub(super) finds: bool,
}

/// How the lights to be sampled are drawn at a hit.
pub(super) enum Draw {
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

/// How likely each of several lights is to be sampled: in proportion to its power but for a tenth, which all that shine
/// share alike. So a weak light beside a strong one is still drawn often enough for the 24 bits of a sample, and
/// where it alone shines it is not all noise.
fn shares(powers: Vec<f64>) -> Vec<f64> {
    let sum: f64 = powers.iter().sum();
    let shining = powers.iter().filter(|&&power| power > 0.0).count() as f64;
    let share = |power: f64| if power > 0.0 { 0.9 * power / sum + 0.1 / shining } else { 0.0 };
    powers.into_iter().map(share).collect()
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
        let power = |i: &usize| {
            let power = lights[*i].power(&sphere).to_array().map(f64::from).iter().sum::<f64>();
            // What is beyond all floats is as bright as can be told.
            if power > 0.0 { power.min(f32::MAX.into()) } else { 0.0 }
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
        } else if let Some(by_power) = Discrete::new(shares(sampled.iter().map(power).collect())) {
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

    /// The most shadow rays that a sample sends at a time: one to each light that is sampled, and a last one into
    /// the sky.
    pub fn shadow_rays(&self) -> usize {
        self.slots() + 1
    }

    /// Adds what arrives along each ray of the wave.
    pub fn shade(&self, scene: &Scene, sampler: &dyn Sampler, wave: &mut Wave) {
        if self.slots() == 0 && !self.on_surfaces && self.infinite.is_empty() {
            return;
        }
        wave.paths.start(wave.rays.len());
        for depth in 0..=self.max_depth {
            self.meet(scene, wave, depth);
            if depth == self.max_depth || wave.paths.met.active.is_empty() {
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
    pub(super) fn goes_on(&self, depth: u32) -> bool {
        depth + 1 < self.max_depth || self.on_surfaces || !self.infinite.is_empty()
    }

    /// Whether paths may end at random after so many reflections. The last ray of a path looks for lights
    /// alone: it is not worth a throw.
    #[inline]
    pub(super) fn throws(&self, depth: u32) -> bool {
        self.roulette && depth >= ROULETTE_FROM && depth + 1 < self.max_depth
    }

    /// Whether it matters what a ray meets that leaves a hit after so many reflections, not only whether it
    /// meets anything.
    #[inline]
    pub(super) fn walks_on(&self, depth: u32) -> bool {
        depth + 1 < self.max_depth || self.on_surfaces
    }

    /// How many lights are sampled at a hit.
    #[inline]
    pub(super) fn slots(&self) -> usize {
        match &self.draw {
            Draw::Each(lights) => lights.len(),
            Draw::One(..) => 1,
        }
    }

    /// Sorts paths by what their rays met, and adds the light that they met.
    #[inline(never)]
    fn meet(&self, scene: &Scene, wave: &mut Wave, depth: u32) {
        let Wave { rays, hits, radiance, paths, .. } = wave;
        let Paths { first, states, met, .. } = paths;
        let states = if depth == 0 { first } else { states };
        let (rays, hits) = if depth == 0 { (&*rays, &*hits) } else { (&paths.rays, &paths.hits) };
        met.sort(scene, hits);
        if !self.infinite.is_empty() {
            for place in met.escaped.iter().map(|&place| place as usize) {
                let (path, ray) = (&states[place], &rays[place]);
                let origin = if depth == 0 { ray.o } else { path.p };
                radiance[path.sample as usize] += self.escaped(scene, origin, ray.d, path);
            }
        }
        if !self.on_surfaces {
            return;
        }
        for place in met.active.iter().map(|&place| place as usize) {
            let (path, ray, hit) = (&states[place], &rays[place], &hits[place]);
            if let Some(number) = scene.light_at(hit) {
                let si = scene.interaction(ray, hit);
                let origin = if depth == 0 { ray.o } else { path.p };
                // As a sample of the light from there would have it: the ray begins a little off.
                let distance = (si.p() - origin).length();
                let at = LightHit { origin, wi: ray.d, distance, n: si.n() };
                radiance[path.sample as usize] += self.found(scene, number, &at, path);
            }
        }
    }

    /// What a path brings home that leaves the scene from `origin` along `wi`.
    #[inline]
    pub(super) fn escaped(&self, scene: &Scene, origin: Vec3, wi: Vec3, path: &Path) -> Spectrum {
        let at = LightHit { origin, wi, distance: f32::INFINITY, n: Vec3::ZERO };
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
        let Paths { first, states, met, values, .. } = paths;
        let states = if depth == 0 { first } else { states };
        let chooses = matches!(self.draw, Draw::One(..));
        if !(self.goes_on(depth) || self.has_places || chooses) {
            return;
        }
        values.ids.clear();
        values
            .ids
            .extend(met.active.iter().map(|&place| ids[states[place as usize].sample as usize]));
        let first = dimension::of_depth(depth);
        if self.goes_on(depth) {
            sampler.fill_2d(&values.ids, first + dimension::DIRECTION, &mut values.direction);
        }
        if self.has_places {
            sampler.fill_2d(&values.ids, first + dimension::LIGHT, &mut values.light);
        }
        if chooses {
            sampler.fill_1d(&values.ids, first + dimension::CHOICE, &mut values.choice);
        }
        if self.throws(depth) {
            sampler.fill_1d(&values.ids, first + dimension::ROULETTE, &mut values.roulette);
        }
    }
}

/// The weight of a sample drawn with density `a` where another way to draw it has density `b`
/// (Veach 1997, section 9.2.4, with exponent 2).
#[inline]
pub(super) fn power_heuristic(a: f32, b: f32) -> f32 {
    // By the ratio: squares of densities leave the range of f32.
    let ratio = b / a;
    1.0 / (1.0 + ratio * ratio)
}
