//! [`Constant`]: a number or a colour.

use crate::params::{Limits, Param, Value};
use crate::spectrum::Spectrum;

/// A number or a colour, as in a scene file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Constant {
    /// A number.
    Number(f32),
    /// A colour.
    Color(Spectrum),
}

impl Param for Constant {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        let number = f32::from_value(value, limits).map(Self::Number);
        number.or_else(|| Spectrum::from_value(value, limits).map(Self::Color))
    }

    fn to_value(&self) -> Option<Value> {
        match self {
            Self::Number(value) => value.to_value(),
            Self::Color(value) => value.to_value(),
        }
    }

    fn expected(_: &Limits) -> String {
        "a number or [red, green, blue], all finite".into()
    }

    fn example(limits: &Limits) -> Self {
        Self::Color(Spectrum::example(limits))
    }
}
