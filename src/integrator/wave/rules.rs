//! [`PathRules`]: which stages paths need at each depth, and how they sample lights.
//!
//! A stage that a scene has no use for is left out: without emissive surfaces hits are not searched for them,
//! with a single light none is chosen, and where no light is left to be found no direction is sampled.

use glam::Vec3;

use super::paths::Path;
use crate::light::{LightChoice, LightHit, LightSampler, LightStrategy};
use crate::scene::Scene;
use crate::spectrum::Spectrum;

/// An integrator's settings, and what follows from them and the scene's lights.
pub struct PathRules {
    pub max_depth: u32,
    roulette: bool,
    /// Chooses the lights that are sampled at a hit.
    pub lights: LightSampler,
    /// Whether any sampled light has an extent, and so needs a 2D sample.
    pub has_places: bool,
    /// For each light: whether rays can hit it.
    visible: Vec<bool>,
    /// Indices of the lights that surround the scene.
    pub infinite: Vec<usize>,
    /// Whether any surface emits light.
    pub on_surfaces: bool,
    /// Whether lights found by reflection count after non-delta events (all strategies but `Light`).
    finds: bool,
}

/// The depth at which Russian roulette starts (PBRT 3rd edition, section 14.5.4).
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

    /// Whether the scene has any light.
    pub fn finds_light(&self) -> bool {
        self.lights.slots() > 0 || self.on_surfaces || !self.infinite.is_empty()
    }

    /// Whether a ray that leaves a vertex of this depth can contribute anything.
    #[inline]
    pub fn goes_on(&self, depth: u32) -> bool {
        depth + 1 < self.max_depth || self.on_surfaces || !self.infinite.is_empty()
    }

    /// Whether Russian roulette is played at this depth. The last ray only looks for lights: ending it early
    /// would save nothing.
    #[inline]
    pub fn throws(&self, depth: u32) -> bool {
        self.roulette && depth >= ROULETTE_FROM && depth + 1 < self.max_depth
    }

    /// Whether the closest hit of a ray that leaves a vertex of this depth is needed, not only whether there
    /// is any.
    #[inline]
    pub fn walks_on(&self, depth: u32) -> bool {
        depth + 1 < self.max_depth || self.on_surfaces
    }

    /// Whether samples of this light are weighed by multiple importance sampling.
    #[inline]
    pub fn weighs(&self, light: usize) -> bool {
        self.finds && self.visible[light]
    }

    /// Weighted radiance of a path that leaves the scene from `origin` along `wi`.
    #[inline]
    pub fn escaped(&self, scene: &Scene, origin: Vec3, wi: Vec3, path: &Path) -> Spectrum {
        let at = LightHit::outside(origin, wi);
        self.infinite.iter().map(|&number| self.found(scene, number, &at, path)).sum()
    }

    /// Weighted radiance of a path that ends at a light.
    #[inline]
    pub fn found(&self, scene: &Scene, number: usize, at: &LightHit, path: &Path) -> Spectrum {
        let light = &*scene.lights()[number];
        let probability = self.lights.probability(number);
        // Light sampling cannot find this path: it comes from the camera or from a delta lobe.
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

/// The power heuristic: the weight of a sample drawn with density `a` that another technique draws with
/// density `b` (Veach 1997, section 9.2.4, with exponent 2).
#[inline]
pub fn power_heuristic(a: f32, b: f32) -> f32 {
    // By the ratio: squares of densities overflow f32.
    let ratio = b / a;
    1.0 / (1.0 + ratio * ratio)
}
