//! [`Limits`]: range and unit of numbers.

use std::fmt::{self, Display, Formatter};

/// Range and unit of the numbers in a value. By default any finite number is valid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    least: Option<Bound>,
    most: Option<Bound>,
    unit: Option<&'static str>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Bound {
    at: f64,
    /// Whether the bound itself is in range.
    included: bool,
}

/// In decimal; large numbers with an exponent, as 1e12.
impl Display for Bound {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        if self.at.abs() >= 1e7 { write!(f, "{:e}", self.at) } else { write!(f, "{}", self.at) }
    }
}

impl Limits {
    /// Any finite number.
    pub const NONE: Self = Self { least: None, most: None, unit: None };

    pub(super) const fn with_least(self, at: f64, included: bool) -> Self {
        Self { least: Some(Bound { at, included }), ..self }
    }

    pub(super) const fn with_most(self, at: f64, included: bool) -> Self {
        Self { most: Some(Bound { at, included }), ..self }
    }

    pub(super) const fn with_unit(self, unit: &'static str) -> Self {
        Self { unit: Some(unit), ..self }
    }

    /// Whether a number is in range. NaN never is.
    pub fn contains(&self, value: f64) -> bool {
        let above = |Bound { at, included }| value > at || included && value == at;
        let below = |Bound { at, included }| value < at || included && value == at;
        self.least.is_none_or(above) && self.most.is_none_or(below) && !value.is_nan()
    }

    /// [`contains`](Self::contains) for `f32`. Bounds are rounded to `f32` first, so that a bound of 0.1 includes 0.1.
    pub fn contains_f32(&self, value: f32) -> bool {
        let round = |bound: Option<Bound>| {
            bound.map(|bound| Bound { at: f64::from(bound.at as f32), ..bound })
        };
        Self { least: round(self.least), most: round(self.most), ..*self }
            .contains(f64::from(value))
    }

    /// A number in range, for examples: 1 if that is in range.
    pub(super) fn example(&self) -> f64 {
        if self.contains(1.0) {
            return 1.0;
        }
        match (self.least, self.most) {
            (Some(least), Some(most)) => 0.5 * (least.at + most.at),
            (Some(least), None) => least.at + 1.0,
            (None, Some(most)) => most.at - 1.0,
            (None, None) => 1.0,
        }
    }

    /// Description for messages and tables, such as "degrees from 0 to 90".
    pub fn describe(&self) -> String {
        match (self.unit, self.range()) {
            (None, None) => "a finite number".into(),
            (None, Some(range)) if self.most.is_none() || self.least.is_none() => {
                format!("a finite number {range}")
            }
            (None, Some(range)) => format!("a number {range}"),
            (Some(unit), None) => format!("{unit}, finite"),
            (Some(unit), Some(range)) => format!("{unit} {range}"),
        }
    }

    /// Description after the word "each".
    pub(super) fn describe_each(&self) -> String {
        match (self.least, self.most, self.unit, self.range()) {
            (Some(_), Some(_), None, Some(range)) => range,
            _ => self.describe(),
        }
    }

    fn range(&self) -> Option<String> {
        Some(match (self.least, self.most) {
            (None, None) => return None,
            (Some(a), None) if a.included => format!("of at least {a}"),
            (Some(a), None) => format!("above {a}"),
            (None, Some(b)) if b.included => format!("of at most {b}"),
            (None, Some(b)) => format!("below {b}"),
            (Some(a), Some(b)) => match (a.included, b.included) {
                (true, true) => format!("from {a} to {b}"),
                (true, false) => format!("of at least {a} and below {b}"),
                (false, true) => format!("above {a} and up to {b}"),
                (false, false) => format!("above {a} and below {b}"),
            },
        })
    }

    /// Description for integers, of which the type's maximum is `max`.
    pub(super) fn describe_whole(&self, max: u64) -> String {
        let least =
            self.least.map_or(0.0, |b| if b.included { b.at.ceil() } else { b.at.floor() + 1.0 });
        match self.most {
            None => format!("a whole number from {least} to {max}"),
            Some(b) => {
                let most = if b.included { b.at.floor() } else { b.at.ceil() - 1.0 };
                format!("a whole number from {least} to {most}")
            }
        }
    }
}
