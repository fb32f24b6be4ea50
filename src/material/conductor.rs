//! [`Conductor`]: the index of refraction of a metal, by its numbers or by name.

use crate::params::{Limits, Param, Value, one_of};
use crate::spectrum::Spectrum;

/// The complex index of refraction eta + i k of a metal, per band. Scene files may name a metal instead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    pub eta: [f32; 3],
    pub k: [f32; 3],
}

const fn metal(eta: [f32; 3], k: [f32; 3]) -> Conductor {
    Conductor { eta, k }
}

/// Indices in air at room temperature, at the dominant wavelengths of the primaries of Rec. 709: 611.4, 549.1 and 464.3 nm, interpolated
/// linearly in the tables named.
const METALS: &[(&str, Conductor)] = &[
    // Rakić 1995, Applied Optics 34.
    ("aluminium", metal([1.322, 1.011, 0.684], [7.311, 6.617, 5.627])),
    // Querry 1985, report CRDC-CR-85034: 70 % copper, 30 % zinc.
    ("brass", metal([0.452, 0.529, 0.954], [3.357, 2.756, 1.915])),
    // Johnson and Christy 1974, Physical Review B 9.
    ("chromium", metal([3.178, 3.180, 2.450], [3.300, 3.330, 3.207])),
    // Johnson and Christy 1972, Physical Review B 6.
    ("copper", Conductor::COPPER),
    // Johnson and Christy 1972.
    ("gold", metal([0.222, 0.428, 1.334], [3.208, 2.461, 1.872])),
    // Johnson and Christy 1974.
    ("iron", metal([2.890, 2.950, 2.643], [3.040, 2.930, 2.803])),
    // Rasigni and Rasigni 1977, Journal of the Optical Society of America 67.
    ("lithium", metal([0.216, 0.205, 0.230], [2.808, 2.469, 1.986])),
    // Inagaki, Arakawa and Williams 1981, Physical Review B 23.
    ("mercury", metal([1.866, 1.548, 1.127], [5.089, 4.644, 3.984])),
    // Johnson and Christy 1974.
    ("nickel", metal([1.985, 1.920, 1.763], [3.985, 3.611, 3.043])),
    // Johnson and Christy 1972.
    ("silver", metal([0.058, 0.060, 0.047], [4.106, 3.590, 2.796])),
    // Johnson and Christy 1974.
    ("titanium", metal([2.659, 2.540, 2.303], [3.698, 3.430, 3.080])),
    // Pflüger and Fink 1991, in Palik, Handbook of Optical Constants of Solids II.
    ("titanium-nitride", metal([1.312, 1.251, 1.407], [2.619, 2.096, 1.417])),
    // Pflüger and Fink 1991.
    ("vanadium-nitride", metal([2.338, 2.247, 2.155], [2.436, 2.190, 1.873])),
];

impl Conductor {
    pub const COPPER: Self = metal([0.362, 1.015, 1.247], [3.127, 2.579, 2.453]);

    /// A metal of the list.
    pub fn named(name: &str) -> Option<Self> {
        METALS.iter().find(|(known, _)| *known == name).map(|(_, conductor)| *conductor)
    }
}

impl Param for Conductor {
    fn from_value(value: &Value, limits: &Limits) -> Option<Self> {
        if let Value::Text(name) = value {
            return Self::named(name);
        }
        let [eta, k] = <[Spectrum; 2]>::from_value(value, limits)?.map(Spectrum::to_array);
        Some(Self { eta, k })
    }

    fn to_value(&self) -> Option<Value> {
        METALS.iter().find(|(_, conductor)| conductor == self).map(|(name, _)| (*name).into())
    }

    fn expected(limits: &Limits) -> String {
        let names = one_of(METALS.iter().map(|(name, _)| format!("{name:?}")));
        format!("a metal: {names}, or [eta, k], each {}", Spectrum::expected(limits))
    }

    fn example(_: &Limits) -> Self {
        METALS[0].1
    }
}
