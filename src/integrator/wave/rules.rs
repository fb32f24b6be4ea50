//! [`PathRules`]: which stages paths need at each depth, and how they sample lights.
//!
//! Stages that a scene does not need are skipped: without emissive surfaces, hits are not tested for emission;
//! with a single light, none is selected; and at the last vertex no direction is sampled unless light found there
//! counts.

use glam::Vec3;

use super::paths::Path;
use crate::light::{LightChoice, LightHit, LightSampler, LightStrategy};
use crate::scene::Scene;
use crate::spectrum::Spectrum;

/// An integrator's settings, and what follows from them for the scene's lights.
pub struct PathRules {
    pub max_depth: u32,
    roulette: bool,
    /// Selects the lights that are sampled at a hit.
    pub lights: LightSampler,
    /// Whether any sampled light is not a delta light, and so needs a 2D sample value.
    pub needs_light_u: bool,
    /// Per light: whether rays can hit it.
    visible: Vec<bool>,
    /// Indices of the lights that surround the scene.
    pub infinite: Vec<usize>,
    /// Whether any surface emits light.
    pub has_area_lights: bool,
    /// Whether light found by BSDF sampling counts (all strategies but `Light`; delta events always count).
    counts_bsdf_samples: bool,
}

/// The depth at which Russian roulette starts (PBRT 3rd edition, section 14.5.4).
const FIRST_ROULETTE_DEPTH: u32 = 3;

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
            needs_light_u: sampled.iter().any(|&i| !lights[i].is_delta()),
            lights: LightSampler::new(lights, sampled, choice, &scene.bounding_sphere()),
            visible,
            has_area_lights: scene.lights_on_surfaces().next().is_some(),
            infinite: (0..lights.len()).filter(|&i| lights[i].is_infinite()).collect(),
            counts_bsdf_samples: strategy != LightStrategy::Light,
        }
    }

    /// Whether the scene has any light.
    pub fn has_lights(&self) -> bool {
        self.lights.slots() > 0 || self.has_area_lights || !self.infinite.is_empty()
    }

    /// Whether a ray that leaves a vertex of this depth can contribute. With strategy `Light`, the last ray of a path
    /// contributes after a delta event only.
    #[inline]
    pub fn contributes(&self, depth: u32, is_delta: bool) -> bool {
        let can_hit_lights = self.has_area_lights || !self.infinite.is_empty();
        depth + 1 < self.max_depth || can_hit_lights && (self.counts_bsdf_samples || is_delta)
    }

    /// Whether any ray that leaves a vertex of this depth can contribute.
    #[inline]
    pub fn samples_direction(&self, depth: u32) -> bool {
        self.contributes(depth, true)
    }

    /// Whether Russian roulette is applied at this depth. Not for the last ray, which only looks for lights: ending
    /// it early would save nothing.
    #[inline]
    pub fn uses_roulette(&self, depth: u32) -> bool {
        self.roulette && depth >= FIRST_ROULETTE_DEPTH && depth + 1 < self.max_depth
    }

    /// Whether a ray that leaves a vertex of this depth needs its closest hit. Otherwise an occlusion test is
    /// enough.
    #[inline]
    pub fn extends_path(&self, depth: u32) -> bool {
        depth + 1 < self.max_depth || self.has_area_lights
    }

    /// Whether multiple importance sampling weights samples of this light.
    #[inline]
    pub fn uses_mis(&self, light: usize) -> bool {
        self.counts_bsdf_samples && self.visible[light]
    }

    /// Weighted radiance of a path that leaves the scene from `origin` along `wi`.
    #[inline]
    pub fn escaped(&self, scene: &Scene, origin: Vec3, wi: Vec3, path: &Path) -> Spectrum {
        let at = LightHit::outside(origin, wi);
        self.infinite.iter().map(|&light| self.emitted(scene, light, &at, path)).sum()
    }

    /// Weighted radiance of a path that ends at the light with this index.
    #[inline]
    pub fn emitted(&self, scene: &Scene, index: usize, at: &LightHit, path: &Path) -> Spectrum {
        let light = &*scene.lights()[index];
        let probability = self.lights.probability(index);
        // Light sampling cannot find paths from the camera or from delta events.
        let weight = if path.pdf == f32::INFINITY || probability == 0.0 {
            1.0
        } else if self.counts_bsdf_samples {
            power_heuristic(path.pdf, probability * light.pdf_li(at))
        } else {
            return Spectrum::BLACK;
        };
        path.beta * light.le(at) * weight
    }
}

/// Power heuristic with exponent 2: weight of a sample drawn with density `a`, where another technique has the
/// density `b` for it (Veach 1997, section 9.2.4).
#[inline]
pub fn power_heuristic(a: f32, b: f32) -> f32 {
    // As a ratio, since squares of densities overflow f32.
    let ratio = b / a;
    1.0 / (1.0 + ratio * ratio)
}
