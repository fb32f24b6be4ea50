//! [`KnownLight`]: lights that are sampled for four points at once.

use std::any::Any;

use glam::{BVec4A, Vec4};

use super::rectangle::RectangleLight;
use super::{AreaLight, Light, PointLight, SkyLight};
use crate::Spectrum;
use crate::geometry::four::Vec3x4;

/// A light of a kind that has a way to do so: what [`Light::sample_li`] gives for each of four points, to the bit.
#[derive(Clone, Copy)]
pub(crate) enum KnownLight {
    Point(PointLight),
    Sky(SkyLight),
    Rectangle(RectangleLight),
}

/// Four of [`LightSample`](super::LightSample), of which some may be missing.
pub(crate) struct LightSamplesX4 {
    pub(crate) exists: BVec4A,
    pub(crate) li: [Spectrum; 4],
    pub(crate) wi: Vec3x4,
    pub(crate) pdf: Vec4,
    /// Where it comes from, if `is_near`.
    pub(crate) from: Vec3x4,
    pub(crate) is_near: BVec4A,
}

impl KnownLight {
    pub(crate) fn new(light: &(impl Light + 'static)) -> Option<Self> {
        let light: &dyn Any = light;
        let point = light.downcast_ref().copied().map(Self::Point);
        let sky = || light.downcast_ref().copied().map(Self::Sky);
        let area = || light.downcast_ref().and_then(AreaLight::rectangle).map(Self::Rectangle);
        point.or_else(sky).or_else(area)
    }
}
