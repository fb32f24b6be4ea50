//! How much memory reading an image may take.

use glam::UVec2;

use crate::spectrum::Spectrum;

/// Why the contents of a file are not an image that can be read.
#[derive(Debug)]
pub enum Refusal {
    /// What is wrong with the contents.
    Contents(String),
    /// What takes how much more than the limit.
    AboveLimit(String),
    /// This many bytes of memory are not available.
    OutOfMemory(u64),
}

impl<T: Into<String>> From<T> for Refusal {
    fn from(reason: T) -> Self {
        Self::Contents(reason.into())
    }
}

/// Bytes of a pixel in memory.
pub const PIXEL: u128 = size_of::<Spectrum>() as u128;

const MIB: u64 = 1 << 20;

/// Bytes in MiB, rounded up.
pub fn mebibytes(bytes: u128) -> u128 {
    bytes.div_ceil(u128::from(MIB))
}

/// Number of pixels. Sides have 32 bits each, so that the product has 64.
pub fn area(size: UVec2) -> u64 {
    u64::from(size.x) * u64::from(size.y)
}

/// Checks that an image of this size, which takes this many bytes to read, stays within the limit.
pub fn check(size: UVec2, bytes: u128, limit: u64) -> Result<(), Refusal> {
    if bytes <= u128::from(limit) {
        return Ok(());
    }
    let (UVec2 { x, y }, needed) = (size, mebibytes(bytes));
    let limit = limit / MIB;
    Err(Refusal::AboveLimit(format!(
        "{x} x {y} pixels take {needed} MiB of memory, above the limit of {limit} MiB"
    )))
}

/// An empty vector with room for exactly this many elements, or how many bytes are not available.
pub fn try_reserve<T>(count: u64) -> Result<Vec<T>, u64> {
    let mut vector = Vec::new();
    let is_reserved =
        usize::try_from(count).is_ok_and(|count| vector.try_reserve_exact(count).is_ok());
    if is_reserved { Ok(vector) } else { Err(count.saturating_mul(size_of::<T>() as u64)) }
}

/// The same as a refusal.
pub fn reserve<T>(count: u64) -> Result<Vec<T>, Refusal> {
    try_reserve(count).map_err(Refusal::OutOfMemory)
}

/// A vector of copies.
pub fn filled<T: Clone>(count: u64, value: T) -> Result<Vec<T>, Refusal> {
    let mut vector = reserve(count)?;
    vector.resize(count as usize, value);
    Ok(vector)
}
