//! [`Direction`], [`Scale`], [`Rotation`], [`Factor`]: parameters of several numbers.

use glam::{Quat, Vec3};

use super::limits::Limits;
use super::param::Param;
use super::tree::Value;
use crate::geometry::unit;
use crate::spectrum::Spectrum;

/// A unit vector, given with any length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Direction(pub Vec3);

impl Param for Direction {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        unit(Vec3::from_value(value, limits)?).map(Self)
    }

    fn to_value(&self) -> Option<Value> {
        self.0.to_value()
    }

    fn expected(_: &Limits) -> String {
        "[x, y, z], finite and not all 0".into()
    }

    fn example(_: &Limits) -> Self {
        Self(Vec3::Z)
    }
}

/// Non-zero scale factors along x, y and z; a single number sets all three.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale(pub Vec3);

impl Param for Scale {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        let factors = f32::from_value(value, limits)
            .map(Vec3::splat)
            .or_else(|| Vec3::from_value(value, limits));
        factors.filter(|factors| factors.cmpne(Vec3::ZERO).all()).map(Self)
    }

    fn to_value(&self) -> Option<Value> {
        let Self(factors) = self;
        if *factors == Vec3::splat(factors.x) { factors.x.to_value() } else { factors.to_value() }
    }

    fn expected(_: &Limits) -> String {
        "a number or [x, y, z], finite and not 0".into()
    }

    fn example(_: &Limits) -> Self {
        Self(Vec3::splat(2.0))
    }
}

/// A rotation about an axis through the origin: about +x it moves y towards z, about +y z towards x, about +z x
/// towards y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// The axis, as a unit vector.
    pub axis: Vec3,
    /// The angle in degrees.
    pub degrees: f32,
}

impl From<Rotation> for Quat {
    fn from(Rotation { axis, degrees }: Rotation) -> Self {
        Self::from_axis_angle(axis, degrees.to_radians())
    }
}

impl Param for Rotation {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        let [x, y, z, degrees] = Param::from_value(value, limits)?;
        Some(Self { axis: unit(Vec3::new(x, y, z))?, degrees })
    }

    fn to_value(&self) -> Option<Value> {
        let Self { axis: Vec3 { x, y, z }, degrees } = *self;
        [x, y, z, degrees].to_value()
    }

    fn expected(_: &Limits) -> String {
        "[x, y, z, degrees], an axis that is not 0 and an angle, all finite".into()
    }

    fn example(_: &Limits) -> Self {
        Self { axis: Vec3::Y, degrees: 90.0 }
    }
}

/// A factor for each band; a single number sets all three.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor(pub Spectrum);

impl Param for Factor {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        let number = f32::from_value(value, limits).map(Spectrum::splat);
        number.or_else(|| Spectrum::from_value(value, limits)).map(Self)
    }

    fn to_value(&self) -> Option<Value> {
        let [r, g, b] = self.0.to_array();
        if r == g && g == b { r.to_value() } else { self.0.to_value() }
    }

    fn expected(limits: &Limits) -> String {
        format!("a number or [red, green, blue], each {}", limits.describe_each())
    }

    fn example(_: &Limits) -> Self {
        Self(Spectrum::splat(0.5))
    }
}
