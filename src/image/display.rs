//! [`Display`]: transfer curves between linear radiance and the 8-bit codes of a screen.

use std::sync::LazyLock;

use crate::params::Choice;
use crate::spectrum::Spectrum;

/// A transfer curve: it encodes linear values as the codes of a screen, 0 to 255.
///
/// The curve's value times 255 is rounded to the nearest code, halves upwards. Negative values and NaN become 0, values
/// that the curve takes above one become 255. Codes are exact: every `f32` gets the code that the formula gives in
/// `f64`. The curves are monotone.
///
/// ```
/// use lobe::image::Display;
/// assert_eq!(Display::Srgb.code(0.5), 188);
/// assert_eq!(Display::Exposure.code(0.5), 220);
/// assert_eq!(Display::Srgb.code(f32::NAN), 0);
/// let linear = Display::Srgb.decode(188.0 / 255.0);
/// assert!((linear - 0.5029).abs() < 1e-4);
/// ```
#[doc(alias = "tone mapping")]
#[doc(alias = "gamma")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Display {
    /// The sRGB curve with both of its pieces (IEC 61966-2-1). White is 1.
    #[default]
    Srgb,
    /// A photographic exposure, 1 - exp(-4 L), without gamma. It approaches white; values from 1.56 on get code 255.
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

    /// The codes of all bands of all pixels: red, green, blue, red, ...
    pub fn codes(self, pixels: &[Spectrum]) -> Vec<u8> {
        let steps = self.steps();
        pixels.iter().flat_map(|pixel| pixel.to_array().map(|band| steps.code(band))).collect()
    }

    /// The linear value that the curve encodes as `encoded`, a code over 255: the inverse of the curve, for `encoded` in
    /// `[0, 1]`. [`Exposure`](Self::Exposure) reaches 1 at infinity only.
    pub fn decode(self, encoded: f64) -> f64 {
        match self {
            Self::Srgb if encoded <= 0.04045 => encoded / 12.92,
            Self::Srgb => ((encoded + 0.055) / 1.055).powf(2.4),
            Self::Exposure => (-encoded).ln_1p() / -4.0,
        }
    }

    /// The curve in words, for the text chunks of PNG files.
    pub(super) fn description(self) -> &'static str {
        match self {
            Self::Srgb => "display curve: sRGB (IEC 61966-2-1) of linear Rec. 709 radiance",
            Self::Exposure => "display curve: 1 - exp(-4 L), without gamma, of linear radiance L",
        }
    }

    fn steps(self) -> &'static Steps {
        static SRGB: LazyLock<Steps> = LazyLock::new(|| Steps::new(Display::Srgb));
        static EXPOSURE: LazyLock<Steps> = LazyLock::new(|| Steps::new(Display::Exposure));
        match self {
            Self::Srgb => &SRGB,
            Self::Exposure => &EXPOSURE,
        }
    }
}

/// A curve as a table of the 255 values where its code increases by one.
struct Steps {
    /// `next[c]` is the smallest value with a code above `c`; NaN for 255, the largest code.
    next: [f32; 256],
    /// For all upper 16 bits from +0 to infinity: the code of the smallest float with these bits. Floats with the same
    /// upper bits differ by less than one part in 128, so at most one step of either curve lies between them.
    codes: Vec<u8>,
}

impl Steps {
    fn new(display: Display) -> Self {
        let mut next = [f32::NAN; 256];
        for (code, next) in next.iter_mut().take(255).enumerate() {
            *next = round_up(display.decode((code as f64 + 0.5) / 255.0));
        }
        let code_of = |value: f32| next[..255].partition_point(|&step| step <= value) as u8;
        let last = f32::INFINITY.to_bits() >> 16;
        Self { next, codes: (0..=last).map(|upper| code_of(f32::from_bits(upper << 16))).collect() }
    }

    #[inline]
    fn code(&self, linear: f32) -> u8 {
        // NaN and both zeros take the other branch.
        if linear > 0.0 {
            let code = self.codes[(linear.to_bits() >> 16) as usize];
            code + u8::from(linear >= self.next[usize::from(code)])
        } else {
            0
        }
    }
}

/// `value` rounded up to `f32`.
fn round_up(value: f64) -> f32 {
    let near = value as f32;
    if f64::from(near) < value { near.next_up() } else { near }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// If no two steps share their upper 16 bits, the table is right everywhere that it is right at the steps, which
    /// tests/output.rs compares with f64.
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
