//! [`PixelSum`]: the sum of a pixel's samples.

use super::stored::Stored;

/// Sum and number of samples.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PixelSum {
    pub values: [f64; 3],
    pub samples: u32,
}

impl PixelSum {
    #[inline]
    pub fn add(&mut self, values: [f32; 3]) {
        add(&mut self.values, values.map(f64::from));
        self.samples += 1;
    }

    pub fn merge(&mut self, other: &Self) {
        add(&mut self.values, other.values);
        self.samples += other.samples;
    }

    /// The mean; zero without samples.
    pub fn mean(&self) -> [f64; 3] {
        self.values.map(|sum| sum / f64::from(self.samples.max(1)))
    }
}

impl Stored for PixelSum {
    fn store(&self, to: &mut Vec<u8>) {
        self.values.store(to);
        self.samples.store(to);
    }

    fn restore(from: &mut &[u8]) -> Option<Self> {
        Some(Self { values: Stored::restore(from)?, samples: u32::restore(from)? })
    }
}

/// Adds band by band.
#[inline]
pub(super) fn add(sum: &mut [f64; 3], values: [f64; 3]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += value;
    }
}

/// `count` default values, or `None` if there is not enough memory.
pub(super) fn zeroed<T: Clone + Default>(count: usize) -> Option<Vec<T>> {
    let mut values = Vec::new();
    values.try_reserve_exact(count).ok()?;
    values.resize(count, T::default());
    Some(values)
}
