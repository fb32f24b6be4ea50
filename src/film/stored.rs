//! [`Stored`]: sums as bytes, bit for bit.

use std::io::{self, Write};

/// A value that is written as bytes, little-endian, and read back bit for bit.
pub(super) trait Stored: Sized {
    /// Appends its bytes.
    fn store(&self, to: &mut Vec<u8>);

    /// Takes its bytes off the front; `None` if there are too few.
    fn restore(from: &mut &[u8]) -> Option<Self>;
}

impl Stored for f64 {
    fn store(&self, to: &mut Vec<u8>) {
        to.extend_from_slice(&self.to_le_bytes());
    }

    fn restore(from: &mut &[u8]) -> Option<Self> {
        let (bytes, rest) = from.split_first_chunk()?;
        *from = rest;
        Some(Self::from_le_bytes(*bytes))
    }
}

impl Stored for u32 {
    fn store(&self, to: &mut Vec<u8>) {
        to.extend_from_slice(&self.to_le_bytes());
    }

    fn restore(from: &mut &[u8]) -> Option<Self> {
        let (bytes, rest) = from.split_first_chunk()?;
        *from = rest;
        Some(Self::from_le_bytes(*bytes))
    }
}

impl Stored for [f64; 3] {
    fn store(&self, to: &mut Vec<u8>) {
        self.iter().for_each(|value| value.store(to));
    }

    fn restore(from: &mut &[u8]) -> Option<Self> {
        Some([f64::restore(from)?, f64::restore(from)?, f64::restore(from)?])
    }
}

/// Writes all values, some thousand at a time.
pub(super) fn write_all<T: Stored>(values: &[T], to: &mut dyn Write) -> io::Result<()> {
    let mut bytes = Vec::new();
    for values in values.chunks(4096) {
        bytes.clear();
        values.iter().for_each(|value| value.store(&mut bytes));
        to.write_all(&bytes)?;
    }
    Ok(())
}

/// Reads as many values as there are in `values`; `None` if there are too few bytes.
pub(super) fn read_all<T: Stored>(values: &mut [T], from: &mut &[u8]) -> Option<()> {
    for value in values {
        *value = T::restore(from)?;
    }
    Some(())
}
