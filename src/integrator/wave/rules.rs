//! [`PathRules`]: what paths do at each depth, and how they look for light.
//!
//! A stage that a scene has no use for is left out: without lights that rays can meet nothing is looked for
//! there, with one light none is chosen, and where nothing is left to be found no direction is drawn.

use glam::Vec3;

use super::paths::Path;
use crate::light::{LightChoice, LightHit, LightSampler};
use crate::scene::{LightStrategy, Scene};
use crate::spectrum::Spectrum;

/// An integrator's settings, and what follows from them and the scene's lights.
pub struct PathRules {
    pub max_depth: u32,
    roulette: bool,
    /// Which lights are sampled at a hit.
    pub lights: LightSampler,
    /// Whether a light that is sampled has an extent, and so asks for a place.
    pub has_places: bool,
    /// By light: whether rays can meet it.
    visible: Vec<bool>,
    /// Lights that rays find which leave the scene.
    pub infinite: Vec<usize>,
    /// Whether there are lights that rays can meet on surfaces.
    pub on_surfaces: bool,
    /// Whether what a ray meets counts, other than through delta lobes and from the camera.
    finds: bool,
}

/// From which reflection on paths may end at random (PBRT 3rd edition, section 14.5.4).
const ROULETTE_FROM: u32 = 3;

impl PathRules {
    pub fn new(
        scene: &Scene,
        max_depth: u32,
        roulette: bool,
        strategy: LightStrategy,
        choice: LightChoice,
    ) -> Self {
        let lights = scene.lights();
        let mut visible: Vec<bool> = lights.iter().map(|light| light.is_infinite()).collect();
        scene.lights_on_surfaces().for_each(|i| visible[i] = true);
        let wanted = |i: &usize| match strategy {
            LightStrategy::Auto => !visible[*i] || lights[*i].is_worth_sampling(),
            LightStrategy::Mis | LightStrategy::Light => true,
            LightStrategy::Bsdf => !visible[*i],
        };
        let sampled: Vec<usize> = (0..lights.len()).filter(wanted).collect();
        Self {
            max_depth,
            roulette,
            has_places: sampled.iter().any(|&i| !lights[i].is_delta()),
            lights: LightSampler::new(lights, sampled, choice, &scene.bounding_sphere()),
            visible,
            on_surfaces: scene.lights_on_surfaces().next().is_some(),
            infinite: (0..lights.len()).filter(|&i| lights[i].is_infinite()).collect(),
            finds: strategy != LightStrategy::Light,
        }
    }

    /// Whether there is any light to be found.
    pub fn finds_light(&self) -> bool {
        self.lights.slots() > 0 || self.on_surfaces || !self.infinite.is_empty()
    }

    /// Whether anything could be made of a ray that leaves a hit after so many reflections.
    #[inline]
    pub fn goes_on(&self, depth: u32) -> bool {
        depth + 1 < self.max_depth || self.on_surfaces || !self.infinite.is_empty()
    }

    /// Whether paths may end at random after so many reflections. The last ray of a path looks for lights
    /// alone: it is not worth a throw.
    #[inline]
    pub fn throws(&self, depth: u32) -> bool {
        self.roulette && depth >= ROULETTE_FROM && depth + 1 < self.max_depth
    }

    /// Whether it matters what a ray meets that leaves a hit after so many reflections, not only whether it
    /// meets anything.
    #[inline]
    pub fn walks_on(&self, depth: u32) -> bool {
        depth + 1 < self.max_depth || self.on_surfaces
    }

    /// Whether samples of this light are weighed against finding it by reflection.
    #[inline]
    pub fn weighs(&self, light: usize) -> bool {
        self.finds && self.visible[light]
    }

    /// What a path brings home that leaves the scene from `origin` along `wi`.
    #[inline]
    pub fn escaped(&self, scene: &Scene, origin: Vec3, wi: Vec3, path: &Path) -> Spectrum {
        let at = LightHit::outside(origin, wi);
        self.infinite.iter().map(|&number| self.found(scene, number, &at, path)).sum()
    }

    /// What a path brings home that ends at a light, weighed against the light's own samples.
    #[inline]
    pub fn found(&self, scene: &Scene, number: usize, at: &LightHit, path: &Path) -> Spectrum {
        let light = &*scene.lights()[number];
        let probability = self.lights.probability(number);
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
}

/// The weight of a sample drawn with density `a` where another way to draw it has density `b`
/// (Veach 1997, section 9.2.4, with exponent 2).
#[inline]
pub fn power_heuristic(a: f32, b: f32) -> f32 {
    // By the ratio: squares of densities leave the range of f32.
    let ratio = b / a;
    1.0 / (1.0 + ratio * ratio)
}
