//! [`Largest`]: how much of a pixel's variance its largest sample holds, and [`Fireflies`].

use super::stored::Stored;
use crate::spectrum::Spectrum;

/// Pixels whose variance is mostly that of one sample: light that the samples hardly ever find. They are told, not changed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Fireflies {
    /// Number of pixels of at least [`Fireflies::SAMPLES`] samples, the largest of which holds more than half of the squared differences of
    /// all of them from their mean, in luminance.
    pub pixels: u64,
    /// What share of all squared differences of the image these samples hold, in `[0, 1]`.
    pub share: f64,
}

impl Fireflies {
    /// Fewer samples tell little: of four, the largest often holds half.
    pub const SAMPLES: u32 = 16;
}

/// Sums over the luminances of a pixel's samples.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Largest {
    sum: f64,
    /// Of the differences from the mean.
    squares: f64,
    largest: f64,
}

impl Largest {
    /// Adds finite samples to `before` of them.
    #[inline]
    pub fn add(&mut self, before: u32, radiance: impl Iterator<Item = Spectrum>) {
        let mut n = f64::from(before);
        for radiance in radiance {
            let y = f64::from(radiance.luminance());
            (n, self.sum) = (n + 1.0, self.sum + y);
            // As in `VarianceSums::add`.
            let difference = n * y - self.sum;
            self.squares += difference * difference / (n * (n - 1.0)).max(1.0);
            self.largest = self.largest.max(y);
        }
    }

    /// Adds those of another film to `before` samples, `more` of them.
    pub fn merge(&mut self, before: u32, other: &Self, more: u32) {
        let (a, b) = (f64::from(before), f64::from(more));
        let difference = other.sum / b.max(1.0) - self.sum / a.max(1.0);
        self.squares += other.squares + a * b / (a + b).max(1.0) * difference * difference;
        self.sum += other.sum;
        self.largest = self.largest.max(other.largest);
    }

    /// The squared differences of all samples, and what the largest one holds of them.
    fn shares(&self, samples: u32) -> [f64; 2] {
        let difference = self.largest - self.sum / f64::from(samples.max(1));
        [self.squares, (difference * difference).min(self.squares)]
    }
}

/// The fireflies of pixels of so many samples each.
pub(super) fn fireflies(pixels: &[Largest], samples: impl Iterator<Item = u32>) -> Fireflies {
    let (mut found, mut of_found, mut all) = (0, 0.0, 0.0);
    for (pixel, samples) in pixels.iter().zip(samples) {
        let [squares, of_largest] = pixel.shares(samples);
        all += squares;
        if samples >= Fireflies::SAMPLES && of_largest > squares / 2.0 {
            found += 1;
            of_found += of_largest;
        }
    }
    Fireflies { pixels: found, share: if all > 0.0 { of_found / all } else { 0.0 } }
}

impl Stored for Largest {
    fn store(&self, to: &mut Vec<u8>) {
        [self.sum, self.squares, self.largest].store(to);
    }

    fn restore(from: &mut &[u8]) -> Option<Self> {
        let [sum, squares, largest] = Stored::restore(from)?;
        Some(Self { sum, squares, largest })
    }
}
