//! [`PathRules`]: which stages paths need at each depth, and how they sample lights.
//!
//! Stages that a scene does not need are skipped: without emissive surfaces, hits are not tested for emission;
//! with a single light, none is selected; and at the last vertex no direction is sampled unless light found there
//! counts.

use glam::Vec3;

use crate::light::{LightChoice, LightSampler, LightStrategy};
use crate::scene::Scene;
use crate::simd::Float;

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

/// The depth at which Russian roulette starts.
const FIRST_ROULETTE_DEPTH: u32 = 2;
/// Paths that carry less than this go on in proportion to what they carry, and then carry this. With 1 they end too often
/// (figures are in docs/light.md).
pub const ROULETTE_WEIGHT: f32 = 0.25;

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

    /// Whether paths that leave `p` and find this light are weighted against light sampling, and the probability of sampling it
    /// there.
    #[inline]
    pub fn weighting(&self, light: usize, p: Vec3) -> Weighting {
        let counts_bsdf_samples = self.counts_bsdf_samples;
        let is_sampled = self.lights.is_sampled(light);
        // A tree is not walked for a light that no path is weighted against.
        let probability = if counts_bsdf_samples { self.lights.probability(light, p) } else { 0.0 };
        Weighting { counts_bsdf_samples, is_sampled, probability }
    }

    /// The [`weighting`](Self::weighting) of a light that surrounds the scene, which is sampled alike everywhere.
    #[inline]
    pub fn weighting_from_anywhere(&self, light: usize) -> Weighting {
        self.weighting(light, Vec3::ZERO)
    }

    /// The [`weighting`](Self::weighting) for paths whose direction light sampling cannot find: from the camera or from delta
    /// events.
    #[inline]
    pub fn weighting_found_only(&self, light: usize) -> Weighting {
        let (counts_bsdf_samples, is_sampled) =
            (self.counts_bsdf_samples, self.lights.is_sampled(light));
        Weighting { counts_bsdf_samples, is_sampled, probability: 0.0 }
    }
}

/// How light that paths find is weighted.
#[derive(Clone, Copy)]
pub struct Weighting {
    counts_bsdf_samples: bool,
    is_sampled: bool,
    probability: f32,
}

impl Weighting {
    /// Whether weights depend on the densities of light sampling.
    #[inline]
    pub fn needs_pdf(self) -> bool {
        self.counts_bsdf_samples && self.is_sampled
    }

    /// The weight of light that a path finds, from the densities with which the path and the light sample the direction.
    #[inline(always)]
    pub fn weight<F: Float>(self, path_pdf: F, light_pdf: F) -> F {
        let found_only = path_pdf.eq(F::splat(f32::INFINITY));
        // Light sampling cannot find paths from the camera or from delta events.
        let (zero, one) = (F::splat(0.0), F::splat(1.0));
        if !self.is_sampled {
            one
        } else if self.counts_bsdf_samples {
            let weight = power_heuristic(path_pdf, F::splat(self.probability) * light_pdf);
            F::select(found_only, one, weight)
        } else {
            F::select(found_only, one, zero)
        }
    }
}

/// Power heuristic with exponent 2: weight of a sample drawn with density `a`, where another technique has the
/// density `b` for it (Veach 1997, section 9.2.4).
#[inline(always)]
pub fn power_heuristic<F: Float>(a: F, b: F) -> F {
    // As a ratio, since squares of densities overflow f32.
    let ratio = b / a;
    let one = F::splat(1.0);
    one / (one + ratio * ratio)
}
