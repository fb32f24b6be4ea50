//! stub
#![allow(missing_docs)]
use super::*;
use crate::shape::TriangleMesh;
pub struct SkyLight(Spectrum);
impl SkyLight {
    pub fn new(l: Spectrum) -> Self {
        Self(l)
    }
}
const P: f32 = 0.25 / std::f32::consts::PI;
impl Light for SkyLight {
    fn is_delta(&self) -> bool {
        false
    }
    fn is_infinite(&self) -> bool {
        true
    }
    fn is_worth_sampling(&self) -> bool {
        false
    }
    fn sample_li(&self, _p: Vec3, u: Vec2) -> Option<LightSample> {
        Some(LightSample {
            li: self.0,
            wi: crate::sampling::uniform_sphere::sample(u),
            pdf: P,
            from: None,
        })
    }
    fn pdf_li(&self, _h: &LightHit) -> f32 {
        P
    }
    fn le(&self, _h: &LightHit) -> Spectrum {
        self.0
    }
    fn power(&self, s: &BoundingSphere) -> Spectrum {
        self.0 * s.radius
    }
}
pub struct DistantLight(Vec3, Spectrum);
impl DistantLight {
    pub fn new(w: Vec3, l: Spectrum) -> Self {
        Self(w, l)
    }
}
impl Light for DistantLight {
    fn is_delta(&self) -> bool {
        true
    }
    fn sample_li(&self, _p: Vec3, _u: Vec2) -> Option<LightSample> {
        Some(LightSample { li: self.1, wi: self.0, pdf: 1.0, from: None })
    }
    fn power(&self, s: &BoundingSphere) -> Spectrum {
        self.1 * s.radius
    }
}
pub struct AreaLight;
impl AreaLight {
    pub fn new(_: &TriangleMesh, _: Spectrum, _: bool) -> Option<Self> {
        None
    }
}
impl Light for AreaLight {
    fn is_delta(&self) -> bool {
        false
    }
    fn sample_li(&self, _p: Vec3, _u: Vec2) -> Option<LightSample> {
        None
    }
    fn power(&self, _s: &BoundingSphere) -> Spectrum {
        Spectrum::WHITE
    }
}
