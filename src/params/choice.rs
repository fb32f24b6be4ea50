//! [`Choice`]: enums whose values have names in scene files and on the command line.

use super::hint::one_of;
use super::limits::Limits;
use super::param::Param;
use super::tree::Value;

/// An enum whose values have names in scene files and on the command line.
pub trait Choice: Copy + PartialEq + Send + Sync + 'static {
    /// All values with their names.
    const CHOICES: &'static [(&'static str, Self)];

    /// The name of this value.
    fn name(self) -> &'static str {
        let found = Self::CHOICES.iter().find(|(_, choice)| *choice == self);
        found.map_or("", |(name, _)| name)
    }
}

impl<T: Choice> Param for T {
    fn from_value(value: &Value, _: &Limits) -> Option<Self> {
        let Value::Text(text) = value else { return None };
        Self::CHOICES.iter().find(|(name, _)| name == text).map(|(_, choice)| *choice)
    }

    fn to_value(&self) -> Option<Value> {
        Some(self.name().into())
    }

    fn expected(_: &Limits) -> String {
        one_of(Self::CHOICES.iter().map(|(name, _)| format!("{name:?}")))
    }

    fn example(_: &Limits) -> Self {
        Self::CHOICES[0].1
    }
}
