//! [`Param`]: types that values of keys can have.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use glam::{UVec2, Vec3};

use super::limits::Limits;
use super::tree::Value;
use crate::spectrum::Spectrum;

/// A type that values of keys can have.
pub trait Param: Clone + Send + Sync + 'static {
    /// Converts a value; `None` if it has another type or is out of range. Limits apply to each number in it.
    fn from_value(value: &Value, limits: &Limits) -> Option<Self>;

    /// Converts back; `None` for a value that is expressed by leaving out the key.
    fn to_value(&self) -> Option<Value>;

    /// Description of valid values, such as "a finite number".
    fn expected(limits: &Limits) -> String;

    /// A valid value.
    fn example(limits: &Limits) -> Self;

    /// Resolves relative paths in the value against `folder`.
    fn placed(self, _folder: &Path) -> Self {
        self
    }

    /// The file that the value names, if it names one.
    fn file(&self) -> Option<&Path> {
        None
    }
}

impl Param for bool {
    fn from_value(value: &Value, _: &Limits) -> Option<Self> {
        if let Value::Boolean(value) = value { Some(*value) } else { None }
    }

    fn to_value(&self) -> Option<Value> {
        Some((*self).into())
    }

    fn expected(_: &Limits) -> String {
        "true or false".into()
    }

    fn example(_: &Limits) -> Self {
        true
    }
}

impl Param for String {
    fn from_value(value: &Value, _: &Limits) -> Option<Self> {
        if let Value::Text(value) = value { Some(value.clone()) } else { None }
    }

    fn to_value(&self) -> Option<Value> {
        Some(self.as_str().into())
    }

    fn expected(_: &Limits) -> String {
        "a text in quotes".into()
    }

    fn example(_: &Limits) -> Self {
        "name".into()
    }
}

/// A file path. Relative paths are resolved against the folder of the document.
impl Param for PathBuf {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        String::from_value(value, limits).map(Self::from)
    }

    fn to_value(&self) -> Option<Value> {
        self.to_str().map(Value::from)
    }

    fn expected(limits: &Limits) -> String {
        String::expected(limits)
    }

    fn example(limits: &Limits) -> Self {
        String::example(limits).into()
    }

    fn placed(self, folder: &Path) -> Self {
        folder.join(self)
    }

    fn file(&self) -> Option<&Path> {
        Some(self)
    }
}

impl Param for f32 {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        number(value).filter(|value: &Self| value.is_finite() && limits.contains_f32(*value))
    }

    fn to_value(&self) -> Option<Value> {
        Some((*self).into())
    }

    fn expected(limits: &Limits) -> String {
        limits.describe()
    }

    fn example(limits: &Limits) -> Self {
        limits.example() as Self
    }
}

impl Param for u32 {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        number(value).filter(|value| limits.contains(f64::from(*value)))
    }

    fn to_value(&self) -> Option<Value> {
        Some(u64::from(*self).into())
    }

    fn expected(limits: &Limits) -> String {
        limits.describe_whole(Self::MAX.into())
    }

    fn example(limits: &Limits) -> Self {
        limits.example() as Self
    }
}

impl Param for u64 {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        number(value).filter(|value| limits.contains(*value as f64))
    }

    fn to_value(&self) -> Option<Value> {
        Some((*self).into())
    }

    fn expected(limits: &Limits) -> String {
        limits.describe_whole(Self::MAX)
    }

    fn example(limits: &Limits) -> Self {
        limits.example() as Self
    }
}

/// Parsed from decimal directly to the type, so that the number is rounded once.
fn number<T: FromStr>(value: &Value) -> Option<T> {
    if let Value::Number(text) = value { text.parse().ok() } else { None }
}

impl<T: Param, const N: usize> Param for [T; N] {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        let Value::Array(nodes) = value else { return None };
        let values = nodes.iter().map(|node| T::from_value(&node.value, limits));
        values.collect::<Option<Vec<T>>>()?.try_into().ok()
    }

    fn to_value(&self) -> Option<Value> {
        self.iter().map(T::to_value).collect()
    }

    fn expected(limits: &Limits) -> String {
        format!("an array of {N}, each {}", T::expected(limits))
    }

    fn example(limits: &Limits) -> Self {
        std::array::from_fn(|_| T::example(limits))
    }

    fn placed(self, folder: &Path) -> Self {
        self.map(|value| value.placed(folder))
    }
}

/// `None` if the key is left out.
impl<T: Param> Param for Option<T> {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        T::from_value(value, limits).map(Some)
    }

    fn to_value(&self) -> Option<Value> {
        self.as_ref().and_then(T::to_value)
    }

    fn expected(limits: &Limits) -> String {
        T::expected(limits)
    }

    fn example(limits: &Limits) -> Self {
        Some(T::example(limits))
    }

    fn placed(self, folder: &Path) -> Self {
        self.map(|value| value.placed(folder))
    }
}

impl Param for Vec3 {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        <[f32; 3]>::from_value(value, limits).map(Self::from)
    }

    fn to_value(&self) -> Option<Value> {
        self.to_array().to_value()
    }

    fn expected(limits: &Limits) -> String {
        if *limits == Limits::NONE {
            return "[x, y, z], all finite".into();
        }
        format!("[x, y, z], each {}", limits.describe_each())
    }

    fn example(limits: &Limits) -> Self {
        <[f32; 3]>::example(limits).into()
    }
}

/// Linear RGB.
impl Param for Spectrum {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        <[f32; 3]>::from_value(value, limits).map(Self::from)
    }

    fn to_value(&self) -> Option<Value> {
        self.to_array().to_value()
    }

    fn expected(limits: &Limits) -> String {
        format!("[red, green, blue], each {}", limits.describe_each())
    }

    fn example(limits: &Limits) -> Self {
        <[f32; 3]>::example(limits).into()
    }
}

impl Param for UVec2 {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        <[u32; 2]>::from_value(value, limits).map(Self::from)
    }

    fn to_value(&self) -> Option<Value> {
        self.to_array().to_value()
    }

    fn expected(limits: &Limits) -> String {
        format!("[x, y], each {}", u32::expected(limits))
    }

    fn example(limits: &Limits) -> Self {
        <[u32; 2]>::example(limits).into()
    }
}
