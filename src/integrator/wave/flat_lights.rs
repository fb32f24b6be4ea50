//! [`LightSamples`]: light samples of four hits.

use glam::{BVec4A, Vec2, Vec4};

use super::flat::FlatHits;
use super::rules::PathRules;
use crate::geometry::Ray;
use crate::geometry::float::ONE_MINUS_EPSILON;
use crate::geometry::four::{Vec3x4, four, rays_x4};
use crate::light::{LightSamplesX4, one_by_one};
use crate::scene::Scene;
use crate::spectrum::Spectrum;

/// Light samples for four hits, with what weighting them needs.
pub struct LightSamples {
    samples: LightSamplesX4,
    /// Whether multiple importance sampling weights them.
    weighed: BVec4A,
}

impl LightSamples {
    /// Samples of a light that every hit samples.
    #[inline(always)]
    pub fn of_one(rules: &PathRules, light: usize, samples: LightSamplesX4) -> Self {
        let weighed = if rules.uses_mis(light) { BVec4A::TRUE } else { BVec4A::FALSE };
        Self { samples, weighed }
    }

    /// A sample for each of the points `p`, from the light that was drawn for it and the sample value, in `drawn`.
    pub fn of_drawn(
        rules: &PathRules,
        scene: &Scene,
        p: Vec3x4,
        drawn: [(usize, Vec2); 4],
    ) -> Self {
        let mut samples = one_by_one(p, |i, p| {
            let (light, u) = drawn[i];
            scene.lights()[light].sample_li(p, u)
        });
        samples.pdf *= Vec4::from_array(four(|i| rules.lights.probability(drawn[i].0)));
        Self { samples, weighed: BVec4A::from_array(four(|i| rules.uses_mis(drawn[i].0))) }
    }

    /// Shadow rays and the radiance that each carries. Bit i of the mask is set if hit i has one. `None` if no hit
    /// has one.
    #[inline(always)]
    pub fn reflected(&self, hits: &FlatHits) -> Option<(u32, [Ray; 4], [Spectrum; 4])> {
        let LightSamplesX4 { exists, ref li, wi, pdf, from, is_near } = self.samples;
        let (reflect, wi_n) = hits.reflect(wi);
        let mask = (reflect & exists).bitmask();
        if mask == 0 {
            return None;
        }
        let mut weight = Vec4::ONE;
        if self.weighed.any() {
            let ratio = FlatHits::pdf(wi_n) / pdf;
            let weighed = 1.0 / (1.0 + ratio * ratio);
            weight = Vec4::select(self.weighed, weighed, weight);
        }
        let factor = (wi_n.abs() * weight / pdf).to_array();
        let reflected = hits.reflected();
        let carried = four(|i| reflected[i] * li[i] * factor[i]);
        let towards = Vec3x4::select(is_near, from - hits.at.p, wi);
        let o = hits.at.ray_origins(hits.n, towards);
        let d = Vec3x4::select(is_near, from - o, wi);
        let t_max =
            Vec4::select(is_near, Vec4::splat(ONE_MINUS_EPSILON), Vec4::splat(f32::INFINITY));
        Some((mask, rays_x4(o, d, t_max), carried))
    }
}
