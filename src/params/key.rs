//! [`Key`]: the declaration of a key, for reading and for documentation.

use std::fmt::Debug;
use std::ops::RangeInclusive;

use super::limits::Limits;
use super::param::Param;
use super::tree::Value;

/// Declaration of a key: name, meaning, range, unit and default. [`Table::get`](super::Table::get) reads by it, and
/// `lobe help` prints it.
///
/// ```
/// use lobe::params::Key;
///
/// const SIGMA: Key<f32> =
///     Key::new("sigma", "standard deviation of slopes").in_unit("degrees").range(0.0..=90.0).default(0.0);
/// ```
///
/// A key without a default is required. A key that may be left out, with no default value, is made by
/// [`Key::optional`].
#[derive(Clone, Copy, Debug)]
pub struct Key<T> {
    name: &'static str,
    meaning: &'static str,
    limits: Limits,
    default: Option<T>,
}

impl<T> Key<T> {
    /// A required key. `meaning` is a phrase for a table, with the unit unless [`Key::in_unit`] gives one.
    pub const fn new(name: &'static str, meaning: &'static str) -> Self {
        Self { name, meaning, limits: Limits::NONE, default: None }
    }

    /// Sets the unit of the numbers: a plural, such as "degrees".
    pub const fn in_unit(mut self, unit: &'static str) -> Self {
        self.limits = self.limits.with_unit(unit);
        self
    }

    /// Restricts numbers to a closed range.
    pub const fn range(mut self, range: RangeInclusive<f64>) -> Self {
        self.limits = self.limits.with_least(*range.start(), true).with_most(*range.end(), true);
        self
    }

    /// Restricts numbers to at least `least`.
    pub const fn at_least(mut self, least: f64) -> Self {
        self.limits = self.limits.with_least(least, true);
        self
    }

    /// Restricts numbers to greater than `least`.
    pub const fn above(mut self, least: f64) -> Self {
        self.limits = self.limits.with_least(least, false);
        self
    }

    /// Restricts numbers to at most `most`.
    pub const fn at_most(mut self, most: f64) -> Self {
        self.limits = self.limits.with_most(most, true);
        self
    }

    /// Restricts numbers to less than `most`.
    pub const fn below(mut self, most: f64) -> Self {
        self.limits = self.limits.with_most(most, false);
        self
    }

    /// The key's name.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// Range and unit.
    pub const fn limits(&self) -> &Limits {
        &self.limits
    }

    pub(super) const fn get_default(&self) -> Option<&T> {
        self.default.as_ref()
    }
}

impl<T: Copy> Key<T> {
    /// Sets the default, which makes the key optional.
    pub const fn default(mut self, value: T) -> Self {
        self.default = Some(value);
        self
    }

    /// The default.
    ///
    /// # Panics
    /// If the key is required.
    pub const fn default_value(&self) -> T {
        self.default.expect("a key with a default")
    }
}

impl<T> Key<Option<T>> {
    /// A key whose value is `None` if it is left out.
    pub const fn optional(name: &'static str, meaning: &'static str) -> Self {
        Self { name, meaning, limits: Limits::NONE, default: Some(None) }
    }
}

/// A key with a value of any type, for [`Kind::keys`](super::Kind::keys).
pub trait AnyKey: Sync {
    /// The key's name.
    fn name(&self) -> &'static str;

    /// Its meaning, as a phrase.
    fn meaning(&self) -> &'static str;

    /// Description of valid values, with range and unit.
    fn expected(&self) -> String;

    /// The default, in the syntax of a scene file, or "none" for [`Key::optional`]. `None` if the key is required.
    fn default_text(&self) -> Option<String>;

    /// A valid value, in the syntax of a scene file.
    fn example(&self) -> String;

    /// Whether the value is valid.
    fn accepts(&self, value: &Value) -> bool;
}

impl<T: Param> AnyKey for Key<T> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn meaning(&self) -> &'static str {
        self.meaning
    }

    fn expected(&self) -> String {
        T::expected(&self.limits)
    }

    fn default_text(&self) -> Option<String> {
        let text = |value: Option<Value>| value.map_or("none".into(), |value| value.to_string());
        self.default.as_ref().map(|default| text(default.to_value()))
    }

    fn example(&self) -> String {
        T::example(&self.limits).to_value().map_or(String::new(), |value| value.to_string())
    }

    fn accepts(&self, value: &Value) -> bool {
        T::from_value(value, &self.limits).is_some()
    }
}

impl Debug for dyn AnyKey {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(self.name())
    }
}
