//! [`Key`]: the declaration of a key, once for reading it and for the tables that list it.

use std::fmt::Debug;
use std::ops::RangeInclusive;

use super::limits::Limits;
use super::param::Param;
use super::tree::Value;

/// A key of a table: its name, what it means, and what its value may be. One constant serves both
/// [`Table::get`](super::Table::get) and the tables of `lobe help`.
///
/// ```
/// use lobe::params::Key;
///
/// const SIGMA: Key<f32> =
///     Key::new("sigma", "standard deviation of slopes").in_unit("degrees").range(0.0..=90.0).default(0.0);
/// ```
///
/// A key without a default is required. One whose value has no default that could be written down, but may be left
/// out, is a [`Key::optional`].
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

    /// Names the unit of the numbers: a plural, such as "degrees".
    pub const fn in_unit(mut self, unit: &'static str) -> Self {
        self.limits = self.limits.with_unit(unit);
        self
    }

    /// Numbers from the one bound to the other, both included.
    pub const fn range(mut self, range: RangeInclusive<f64>) -> Self {
        self.limits = self.limits.with_least(*range.start(), true).with_most(*range.end(), true);
        self
    }

    /// Numbers of at least this.
    pub const fn at_least(mut self, least: f64) -> Self {
        self.limits = self.limits.with_least(least, true);
        self
    }

    /// Numbers greater than this.
    pub const fn above(mut self, least: f64) -> Self {
        self.limits = self.limits.with_least(least, false);
        self
    }

    /// Numbers of at most this.
    pub const fn at_most(mut self, most: f64) -> Self {
        self.limits = self.limits.with_most(most, true);
        self
    }

    /// Numbers less than this.
    pub const fn below(mut self, most: f64) -> Self {
        self.limits = self.limits.with_most(most, false);
        self
    }

    /// Its name.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The range of its numbers.
    pub const fn limits(&self) -> &Limits {
        &self.limits
    }

    pub(super) const fn get_default(&self) -> Option<&T> {
        self.default.as_ref()
    }
}

impl<T: Copy> Key<T> {
    /// Gives the value if the key is left out.
    pub const fn default(mut self, value: T) -> Self {
        self.default = Some(value);
        self
    }

    /// The value if the key is left out.
    ///
    /// # Panics
    /// If it is required.
    pub const fn default_value(&self) -> T {
        self.default.expect("a key with a default")
    }
}

impl<T> Key<Option<T>> {
    /// A key that may be left out: its value is `None` then.
    pub const fn optional(name: &'static str, meaning: &'static str) -> Self {
        Self { name, meaning, limits: Limits::NONE, default: Some(None) }
    }
}

/// A key of any type, for the list of a [`Kind`](super::Kind).
pub trait AnyKey: Sync {
    /// Its name.
    fn name(&self) -> &'static str;

    /// What it means, as a phrase.
    fn meaning(&self) -> &'static str;

    /// What its value has to be, in words, with range and unit.
    fn expected(&self) -> String;

    /// The value if it is left out, as it could stand in a file; "none" for nothing. `None` if it is required.
    fn default_text(&self) -> Option<String>;

    /// Some value that can be read, as it could stand in a file.
    fn example(&self) -> String;

    /// Whether this value can be read.
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
