//! [`Medium`]: an index of refraction, by its number or by the name of a medium.

use crate::params::{Limits, Param, Value, one_of};

/// An index of refraction. Scene files may name a medium instead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium(pub f32);

/// Indices of refraction at the sodium D line, 589 nm, in air or vacuum.
const MEDIA: &[(&str, f32)] = &[
    // Ciddor 1996, at 15 °C.
    ("air", 1.000_277),
    // Warren 1984.
    ("ice", 1.31),
    // Hale and Querry 1973, at 25 °C.
    ("water", 1.333),
    // Malitson 1965: fused silica.
    ("silica", 1.4585),
    // Szczurowski 2013: polymethyl methacrylate.
    ("acrylic", 1.4906),
    // Schott's data sheet: N-BK7, a common crown.
    ("glass-bk7", 1.5168),
    // Sultanova, Kasarova and Nikolov 2009.
    ("polycarbonate", 1.5848),
    // Malitson 1962: the ordinary ray.
    ("sapphire", 1.7682),
    // Phillip and Taft 1964.
    ("diamond", 2.417),
];

impl Param for Medium {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        match value {
            Value::Text(name) => {
                MEDIA.iter().find(|(known, _)| known == name).map(|(_, eta)| Self(*eta))
            }
            _ => f32::from_value(value, limits).map(Self),
        }
    }

    fn to_value(&self) -> Option<Value> {
        self.0.to_value()
    }

    fn expected(limits: &Limits) -> String {
        let names = one_of(MEDIA.iter().map(|(name, _)| format!("{name:?}")));
        format!("{}, or a medium: {names}", f32::expected(limits))
    }

    fn example(limits: &Limits) -> Self {
        Self(f32::example(limits))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Key;

    /// Seen to fail with the first medium taken for all, and with numbers out of range.
    #[test]
    fn an_index_is_a_number_or_a_name() {
        const KEY: Key<Medium> = Key::new("eta", "an index").range(0.1..=10.0);
        let read = |value: Value| Medium::from_value(&value, KEY.limits()).map(|Medium(eta)| eta);
        for &(name, eta) in MEDIA {
            assert_eq!(read(name.into()), Some(eta), "{name}");
            assert!((1.0..3.0).contains(&eta), "{name}");
        }
        assert_eq!(read("diamond".into()), Some(2.417));
        assert_eq!(read("Diamond".into()), None);
        assert_eq!(read(Value::Number("1.33".into())), Some(1.33));
        assert_eq!(read(Value::Number("0".into())), None);
    }
}
