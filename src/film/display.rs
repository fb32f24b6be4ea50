//! [`Display`]: from linear radiance to the 8-bit codes of a screen.

use std::sync::LazyLock;

use crate::params::Choice;
use crate::spectrum::Spectrum;

/// The curve that takes linear values to a screen's codes, 0 to 255.
///
/// A value below zero, and NaN, is shown as 0; a value that the curve takes above one, as 255. In
/// between the curve's value times 255 is rounded to the nearest code, a half upwards. Codes are
/// exact: every `f32` gets the code that the formula gives in `f64`. The curves are monotone.
///
/// ```
/// use lobe::film::Display;
/// assert_eq!(Display::Srgb.code(0.5), 188);
/// assert_eq!(Display::Exposure.code(0.5), 220);
/// assert_eq!(Display::Srgb.code(f32::NAN), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Display {
    /// The curve of sRGB, exact and in two pieces (IEC 61966-2-1): 1 is white.
    #[default]
    Srgb,
    /// An exposure, 1 - exp(-4 L), without any gamma: white is never reached, code 255 from 1.56 on.
    Exposure,
}

impl Choice for Display {
    const CHOICES: &'static [(&'static str, Self)] =
        &[("srgb", Self::Srgb), ("exposure", Self::Exposure)];
}

impl Display {
    /// The code of one linear value.
    pub fn code(self, linear: f32) -> u8 {
        self.steps().code(linear)
    }

    /// The codes of every band of every pixel: red, green, blue, red, ...
    pub fn codes(self, pixels: &[Spectrum]) -> Vec<u8> {
        let steps = self.steps();
        pixels.iter().flat_map(|pixel| pixel.to_array().map(|band| steps.code(band))).collect()
    }

    /// What the curve does, for the notes in a file.
    pub(super) fn description(self) -> &'static str {
        match self {
            Self::Srgb => "display curve: sRGB (IEC 61966-2-1) of linear Rec. 709 radiance",
            Self::Exposure => "display curve: 1 - exp(-4 L), without gamma, of linear radiance L",
        }
    }

    fn steps(self) -> &'static Steps {
        static SRGB: LazyLock<Steps> = LazyLock::new(|| Steps::new(srgb_inverse));
        static EXPOSURE: LazyLock<Steps> = LazyLock::new(|| Steps::new(exposure_inverse));
        match self {
            Self::Srgb => &SRGB,
            Self::Exposure => &EXPOSURE,
        }
    }
}

/// The linear value that sRGB shows as `y`.
fn srgb_inverse(y: f64) -> f64 {
    if y <= 0.04045 { y / 12.92 } else { ((y + 0.055) / 1.055).powf(2.4) }
}

/// The linear value that the exposure shows as `y`.
fn exposure_inverse(y: f64) -> f64 {
    (-y).ln_1p() / -4.0
}

/// A monotone curve as the 255 places where its code steps up by one.
struct Steps {
    /// `next[c]` is the smallest value with a code above `c`; NaN for 255, above which there is none.
    next: [f32; 256],
    /// The code of the smallest float that has these upper 16 bits, for all from +0 to infinity.
    /// Floats that share them are less than one part in 128 apart, so close that at most one step
    /// of either curve lies between them.
    codes: Vec<u8>,
}

impl Steps {
    fn new(inverse: fn(f64) -> f64) -> Self {
        let mut next = [f32::NAN; 256];
        for (code, next) in next.iter_mut().take(255).enumerate() {
            *next = round_up(inverse((code as f64 + 0.5) / 255.0));
        }
        let code_of = |value: f32| next[..255].partition_point(|&step| step <= value) as u8;
        let last = f32::INFINITY.to_bits() >> 16;
        Self { next, codes: (0..=last).map(|upper| code_of(f32::from_bits(upper << 16))).collect() }
    }

    #[inline]
    fn code(&self, linear: f32) -> u8 {
        // False for NaN and for both zeros, too.
        if linear > 0.0 {
            let code = self.codes[(linear.to_bits() >> 16) as usize];
            code + u8::from(linear >= self.next[usize::from(code)])
        } else {
            0
        }
    }
}

/// The smallest `f32` that is not below `value`.
fn round_up(value: f64) -> f32 {
    let near = value as f32;
    if f64::from(near) < value { near.next_up() } else { near }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table is right everywhere if no two steps share their upper 16 bits: with that, the
    /// test of every step against f64 (tests/output.rs) proves every float.
    #[test]
    fn no_two_steps_share_a_bucket() {
        for display in [Display::Srgb, Display::Exposure] {
            let steps = &display.steps().next[..255];
            for pair in steps.windows(2) {
                assert!(pair[0].to_bits() >> 16 < pair[1].to_bits() >> 16, "{display:?} {pair:?}");
            }
        }
    }
}
