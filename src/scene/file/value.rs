//! [`FromValue`]: from TOML values to what settings are made of.

use glam::{Quat, UVec2, Vec3};

use super::description::{Source, TextureDescription};
use super::tree::Value;
use crate::geometry::unit;

/// A type that a value of a scene file can have.
pub trait FromValue: Sized {
    /// The value, or `None` if it has another type or is out of range.
    fn from_value(value: &Value) -> Option<Self>;

    /// What a value has to be, for messages.
    fn expected() -> String;
}

impl FromValue for bool {
    fn from_value(value: &Value) -> Option<Self> {
        if let Value::Boolean(value) = value { Some(*value) } else { None }
    }

    fn expected() -> String {
        "true or false".into()
    }
}

impl FromValue for String {
    fn from_value(value: &Value) -> Option<Self> {
        if let Value::Text(value) = value { Some(value.clone()) } else { None }
    }

    fn expected() -> String {
        "a text in quotes".into()
    }
}

impl FromValue for f32 {
    fn from_value(value: &Value) -> Option<Self> {
        number(value).filter(|value: &Self| value.is_finite())
    }

    fn expected() -> String {
        "a finite number".into()
    }
}

impl FromValue for u32 {
    fn from_value(value: &Value) -> Option<Self> {
        number(value)
    }

    fn expected() -> String {
        format!("a whole number from 0 to {}", Self::MAX)
    }
}

impl FromValue for u64 {
    fn from_value(value: &Value) -> Option<Self> {
        number(value)
    }

    fn expected() -> String {
        format!("a whole number from 0 to {}", Self::MAX)
    }
}

/// Once from decimal to the type, so that nothing is rounded twice.
fn number<T: std::str::FromStr>(value: &Value) -> Option<T> {
    if let Value::Number(text) = value { text.parse().ok() } else { None }
}

impl<T: FromValue, const N: usize> FromValue for [T; N] {
    fn from_value(value: &Value) -> Option<Self> {
        let Value::Array(nodes) = value else { return None };
        let values: Option<Vec<T>> = nodes.iter().map(|node| T::from_value(&node.value)).collect();
        values?.try_into().ok()
    }

    fn expected() -> String {
        format!("an array of {N}, each {}", T::expected())
    }
}

impl FromValue for Vec3 {
    fn from_value(value: &Value) -> Option<Self> {
        <[f32; 3]>::from_value(value).map(Self::from)
    }

    fn expected() -> String {
        <[f32; 3]>::expected()
    }
}

impl FromValue for UVec2 {
    fn from_value(value: &Value) -> Option<Self> {
        <[u32; 2]>::from_value(value).map(Self::from)
    }

    fn expected() -> String {
        <[u32; 2]>::expected()
    }
}

/// Radiance, irradiance or intensity by band.
pub struct Light(pub [f32; 3]);

impl FromValue for Light {
    fn from_value(value: &Value) -> Option<Self> {
        FromValue::from_value(value).filter(|i: &[f32; 3]| i.iter().all(|&i| i >= 0.0)).map(Self)
    }

    fn expected() -> String {
        "[red, green, blue], each a finite number of at least 0".into()
    }
}

/// A direction of any length, brought to unit length.
pub struct Direction(pub Vec3);

impl FromValue for Direction {
    fn from_value(value: &Value) -> Option<Self> {
        unit(Vec3::from_value(value)?).map(Self)
    }

    fn expected() -> String {
        "[x, y, z], finite and not all 0".into()
    }
}

/// Factors along x, y and z; one number is all three.
pub struct Scale(pub Vec3);

impl FromValue for Scale {
    fn from_value(value: &Value) -> Option<Self> {
        let factors = f32::from_value(value).map(Vec3::splat).or_else(|| Vec3::from_value(value));
        factors.filter(|factors| factors.cmpne(Vec3::ZERO).all()).map(Self)
    }

    fn expected() -> String {
        "a number or [x, y, z], finite and not 0".into()
    }
}

/// A turn around an axis through the origin: from y towards z around +x, and so on.
pub struct Rotation(pub Quat);

impl FromValue for Rotation {
    fn from_value(value: &Value) -> Option<Self> {
        let [x, y, z, degrees] = FromValue::from_value(value)?;
        let axis = unit(Vec3::new(x, y, z))?;
        Some(Self(Quat::from_axis_angle(axis, f32::to_radians(degrees))))
    }

    fn expected() -> String {
        "[x, y, z, degrees], an axis that is not 0 and an angle, all finite".into()
    }
}

impl FromValue for TextureDescription {
    fn from_value(value: &Value) -> Option<Self> {
        let number = f32::from_value(value).map(Self::ConstantNumber);
        number.or_else(|| FromValue::from_value(value).map(Self::ConstantColor))
    }

    fn expected() -> String {
        "a number or [red, green, blue], all finite".into()
    }
}

impl FromValue for Source {
    fn from_value(value: &Value) -> Option<Self> {
        let name = String::from_value(value).map(Self::Texture);
        name.or_else(|| FromValue::from_value(value).map(Self::Value))
    }

    fn expected() -> String {
        format!("a texture's name, {}", TextureDescription::expected())
    }
}
