//! [`LightSamples`]: light that may arrive at four hits.

use glam::{BVec4A, Vec2, Vec4};

use super::plain::PlainHits;
use super::transport::Transport;
use crate::Spectrum;
use crate::geometry::Ray;
use crate::geometry::float::ONE_MINUS_EPSILON;
use crate::geometry::four::{self, Vec3x4};
use crate::light::{LightSample, PointLight};
use crate::scene::Scene;

/// Four of [`LightSample`], of which some may be missing.
pub struct LightSamples {
    exists: BVec4A,
    li: [Spectrum; 4],
    wi: Vec3x4,
    /// With the probability of the light.
    pdf: Vec4,
    /// Where it comes from, if `is_near`.
    from: Vec3x4,
    is_near: BVec4A,
    /// Whether reflection may find the same light.
    weighed: BVec4A,
}

impl LightSamples {
    /// A sample for each of the points `p`, of the light with the number beside its place on the light.
    #[inline(always)]
    pub fn new(transport: &Transport, scene: &Scene, p: Vec3x4, drawn: [(usize, Vec2); 4]) -> Self {
        let number = drawn[0].0;
        let same = drawn.iter().all(|&(other, _)| other == number);
        match transport.points[number] {
            Some(light) if same => Self::of_point(light, transport.probability[number], p),
            _ => Self::of_any(transport, scene, p, drawn),
        }
    }

    #[inline(always)]
    fn of_point(light: PointLight, probability: f32, p: Vec3x4) -> Self {
        let from = Vec3x4::splat(light.position());
        let to_light = from - p;
        let distance2 = to_light.length_squared();
        let falloff = distance2.to_array();
        Self {
            exists: distance2.cmpgt(Vec4::ZERO),
            li: falloff.map(|distance2| light.intensity() / distance2),
            wi: to_light.divided_by(distance2.sqrt()),
            pdf: Vec4::splat(probability),
            from,
            is_near: BVec4A::TRUE,
            weighed: BVec4A::FALSE,
        }
    }

    #[inline(never)]
    fn of_any(transport: &Transport, scene: &Scene, p: Vec3x4, drawn: [(usize, Vec2); 4]) -> Self {
        let p = p.rows(Vec4::ZERO);
        let samples: [_; 4] = std::array::from_fn(|i| {
            let (number, u) = drawn[i];
            scene.lights()[number].sample_li(p[i].truncate(), u)
        });
        let none = LightSample { li: Spectrum::BLACK, wi: glam::Vec3::Z, pdf: 1.0, from: None };
        let exists = BVec4A::from_array(samples.map(|sample| sample.is_some()));
        let samples = samples.map(|sample| sample.unwrap_or(none));
        let from = samples.map(|sample| sample.from.unwrap_or_default());
        let probability = drawn.map(|(number, _)| transport.probability[number]);
        Self {
            exists,
            li: samples.map(|sample| sample.li),
            wi: Vec3x4::new(samples.each_ref().map(|sample| &sample.wi)),
            pdf: Vec4::from_array(samples.map(|sample| sample.pdf)) * Vec4::from_array(probability),
            from: Vec3x4::new(from.each_ref()),
            is_near: BVec4A::from_array(samples.map(|sample| sample.from.is_some())),
            weighed: BVec4A::from_array(
                drawn.map(|(number, _)| transport.finds && !scene.lights()[number].is_delta()),
            ),
        }
    }

    /// Shadow rays, and what each carries. Bit i of the mask is for the i-th.
    #[inline(always)]
    pub fn reflected(&self, hits: &PlainHits) -> (u32, [Ray; 4], [Spectrum; 4]) {
        let (reflect, wi_n) = hits.reflect(self.wi);
        let mut weight = Vec4::ONE;
        if self.weighed.any() {
            let ratio = hits.pdf(wi_n) / self.pdf;
            let weighed = 1.0 / (1.0 + ratio * ratio);
            weight = Vec4::select(self.weighed, weighed, weight);
        }
        let factor = (wi_n.abs() * weight / self.pdf).to_array();
        let reflected = hits.reflected();
        let carried = std::array::from_fn(|i| reflected[i] * self.li[i] * factor[i]);
        let towards = Vec3x4::select(self.is_near, self.from - hits.at.p, self.wi);
        let o = hits.at.ray_origins(hits.n, towards);
        let d = Vec3x4::select(self.is_near, self.from - o, self.wi);
        let t_max =
            Vec4::select(self.is_near, Vec4::splat(ONE_MINUS_EPSILON), Vec4::splat(f32::INFINITY));
        ((reflect & self.exists).bitmask(), four::rays(o, d, t_max), carried)
    }
}
