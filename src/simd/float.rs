//! [`Float`]: what formulas are generic over. [`Block`]: what loops over blocks of numbers need besides.
//!
//! Each operation is the IEEE 754 operation in each lane, and no multiply-add is fused. So a formula gives the same bits for
//! one f32 and in each lane of a vector.

use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

use glam::Vec2;

use super::angle;

/// One number or several: f32, f64, or a vector of f32. A formula that is generic over it stands once for all of them.
pub trait Float:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Which lanes satisfy a condition.
    type Mask: LaneMask;
    /// The bits of each number, as a signed integer of the same size.
    type Bits: Bits;

    /// The same number in all lanes.
    fn splat(x: f32) -> Self;
    /// The same number in all lanes, rounded if the lanes are f32.
    fn constant(x: f64) -> Self;
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    /// The largest integer that is not larger.
    fn floor(self) -> Self;
    /// The magnitude of `self` with the sign of `sign`.
    fn copysign(self, sign: Self) -> Self;
    /// The smaller number; `other` where either is NaN.
    fn min(self, other: Self) -> Self;
    /// The larger number; `other` where either is NaN.
    fn max(self, other: Self) -> Self;
    /// Lanes where `self < other`; false where either is NaN.
    fn lt(self, other: Self) -> Self::Mask;
    /// Lanes where `self <= other`; false where either is NaN.
    fn le(self, other: Self) -> Self::Mask;
    /// Lanes where both are equal; false where either is NaN.
    fn eq(self, other: Self) -> Self::Mask;
    /// `yes` in the lanes of `mask`, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    fn to_bits(self) -> Self::Bits;
    fn from_bits(bits: Self::Bits) -> Self;

    #[inline(always)]
    fn gt(self, other: Self) -> Self::Mask {
        other.lt(self)
    }

    #[inline(always)]
    fn ge(self, other: Self) -> Self::Mask {
        other.le(self)
    }

    /// (cos φ, sin φ) at φ = 2π · `self`, for numbers in `[0, 1]`.
    #[inline(always)]
    fn unit_circle(self) -> [Self; 2] {
        angle::unit_circle(self)
    }

    /// The angle from (1, 0) to (`x`, `self`) in radians, in `[-π, π]`; unspecified if both are 0.
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        angle::atan2(self, x)
    }
}

/// Which lanes satisfy a condition.
pub trait LaneMask:
    Copy
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + BitXor<Output = Self>
    + Not<Output = Self>
{
    /// Number of lanes.
    const LANES: u32;

    /// All lanes, or none.
    #[inline(always)]
    fn splat(is: bool) -> Self {
        Self::from_bits(if is { u32::MAX } else { 0 })
    }
    /// The inverse of [`bits`](Self::bits).
    fn from_bits(bits: u32) -> Self;
    /// One bit per lane, lane 0 lowest.
    fn bits(self) -> u32;
    /// Whether any lane does.
    fn any(self) -> bool;
    /// Whether all lanes do.
    fn all(self) -> bool;
}

/// A signed integer for each lane. Sums wrap.
pub trait Bits: Copy + BitOr<Output = Self> + BitXor<Output = Self> + Add<Output = Self> {
    /// The same integer in all lanes.
    fn splat(x: i32) -> Self;
    /// -1 in lanes that are negative, 0 in others.
    fn is_negative(self) -> Self;
}

/// A [`Float`] of f32 that is loaded from memory and stored to it.
pub trait Block: Float {
    /// Number of lanes.
    const LANES: usize;

    /// The first numbers of a slice.
    ///
    /// # Panics
    /// If there are fewer than lanes, as all methods with slices do.
    fn load(from: &[f32]) -> Self;
    /// Writes to the first numbers of a slice.
    fn store(self, to: &mut [f32]);
    /// First and second numbers of the first pairs of a slice.
    fn load_pairs(from: &[Vec2]) -> [Self; 2];
    /// Number i of each of as many records as lanes, for each i: `record` returns the one for a lane.
    fn gather<'a>(record: impl Fn(usize) -> &'a [f32; 8]) -> [Self; 8];
    /// The same for records of four numbers.
    fn gather4<'a>(record: impl Fn(usize) -> &'a [f32; 4]) -> [Self; 4];
    /// The inverse of [`gather`](Self::gather): writes number i of each record from element i.
    fn scatter(rows: [Self; 8], to: &mut [[f32; 8]]);
    /// The same for records of four numbers.
    fn scatter4(rows: [Self; 4], to: &mut [[f32; 4]]);
}

/// The array `[f(0), f(1), f(2), f(3)]`. Always inlined, unlike `std::array::from_fn` and `map`, which code with vectors must
/// not use: a function of its own is not compiled for their instructions. Nor is a closure that is called more than once.
#[inline(always)]
pub fn four<T>(mut f: impl FnMut(usize) -> T) -> [T; 4] {
    [f(0), f(1), f(2), f(3)]
}
