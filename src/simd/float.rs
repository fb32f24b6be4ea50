//! [`Float`]: what formulas are generic over. [`Block`]: what loops over blocks of numbers need besides.
//!
//! Each operation is the IEEE 754 operation in each lane, and no multiply-add is fused, but for the distances to boxes (`Eight::mul_add`), which are padded. So a formula gives the same bits for
//! one f32 and in each lane of a vector.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, SQRT_2};
use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

use glam::Vec2;

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
        unit_circle(self)
    }

    /// The angle from (1, 0) to (`x`, `self`) in radians, in `[-π, π]`; unspecified if both are 0.
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        atan2(self, x)
    }
}

/// One bit per lane, lane 0 lowest.
pub type Mask = u32;

/// Which lanes satisfy a condition.
pub trait LaneMask:
    Copy + BitAnd<Output = Self> + BitOr<Output = Self> + BitXor<Output = Self> + Not<Output = Self>
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

/// A signed integer for each lane.
pub trait Bits: Copy + BitOr<Output = Self> + BitXor<Output = Self> {
    /// The same integer in all lanes.
    fn splat(x: i32) -> Self;
    fn wrapping_add(self, other: Self) -> Self;
    /// -1 in lanes that are negative, 0 in others.
    fn is_negative(self) -> Self;
}

/// Most lanes of a [`Block`].
pub const MAX_LANES: usize = 16;

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
    /// Applies a function of one number to each lane.
    #[inline(always)]
    fn each(self, mut f: impl FnMut(f32) -> f32) -> Self {
        let mut x = [0.0; MAX_LANES];
        self.store(&mut x);
        for x in &mut x[..Self::LANES] {
            *x = f(*x);
        }
        Self::load(&x)
    }
    /// Applies a function of two numbers to each lane of two vectors.
    #[inline(always)]
    fn zip_each(self, other: Self, mut f: impl FnMut(f32, f32) -> f32) -> Self {
        let (mut x, mut y) = ([0.0; MAX_LANES], [0.0; MAX_LANES]);
        self.store(&mut x);
        other.store(&mut y);
        for lane in 0..Self::LANES {
            x[lane] = f(x[lane], y[lane]);
        }
        Self::load(&x)
    }
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

// Sine, cosine and atan2 in f32 by polynomials: faster than the system's library, and the same bits on every platform.

/// (cos φ, sin φ) at φ = π/4 · `share`, for `share` in `[-1, 1]`. Absolute error of each: at most
/// 2⁻²³.
#[inline(always)]
pub fn eighth_turn<F: Float>(share: F) -> [F; 2] {
    let c = F::constant;
    let x = c(FRAC_PI_4) * share;
    let x2 = x * x;
    // Taylor series in Horner's form: the coefficients are 1/n! with alternating signs.
    let [c4, c6, c8] = [c(1.0 / 24.0), c(-1.0 / 720.0), c(1.0 / 40_320.0)];
    let cos = c(1.0) + x2 * (c(-0.5) + x2 * (c4 + x2 * (c6 + x2 * c8)));
    let [s3, s5, s7, s9] = [c(-1.0 / 6.0), c(1.0 / 120.0), c(-1.0 / 5_040.0), c(1.0 / 362_880.0)];
    let sin = x + x * x2 * (s3 + x2 * (s5 + x2 * (s7 + x2 * s9)));
    [cos, sin]
}

/// (cos φ, sin φ) at φ = 2π · `turn`, for `turn` in `[0, 1]`. Absolute error of each: at most 2⁻²³.
#[inline(always)]
fn unit_circle<F: Float>(turn: F) -> [F; 2] {
    // Range reduction to an eighth of a turn on either side of the nearest quarter turn. The
    // subtraction is exact.
    let turns = F::splat(4.0) * turn;
    let quarter = (turns + F::splat(0.5)).floor();
    let [cos, sin] = eighth_turn(F::splat(2.0) * (turns - quarter));
    let [one, two, three] =
        [quarter.eq(F::splat(1.0)), quarter.eq(F::splat(2.0)), quarter.eq(F::splat(3.0))];
    let swap = one | three;
    let (x, y) = (F::select(swap, sin, cos), F::select(swap, cos, sin));
    [F::select(one | two, -x, x), F::select(two | three, -y, y)]
}

/// The angle from (1, 0) to (x, y) in radians, in `[-π, π]`.
///
/// Absolute error at most 3e-7, relative error at most 3e-7. Unspecified for (0, 0).
#[inline(always)]
fn atan2<F: Float>(y: F, x: F) -> F {
    let c = F::constant;
    let (across, along) = (x.abs(), y.abs());
    let steep = along.gt(across);
    let tangent = F::select(steep, across, along) / F::select(steep, along, across);
    // Range reduction: tan(φ - π/4) = (t - 1)/(t + 1), used where it is the smaller one.
    let far = tangent.gt(c(SQRT_2 - 1.0));
    let t = F::select(far, (tangent - c(1.0)) / (tangent + c(1.0)), tangent);
    let t2 = t * t;
    let [t3, t5, t7, t9] = [c(-1.0 / 3.0), c(1.0 / 5.0), c(-1.0 / 7.0), c(1.0 / 9.0)];
    let [t11, t13, t15] = [c(-1.0 / 11.0), c(1.0 / 13.0), c(-1.0 / 15.0)];
    let series = t2 * (t7 + t2 * (t9 + t2 * (t11 + t2 * (t13 + t2 * t15))));
    let angle = t + t * t2 * (t3 + t2 * (t5 + series));
    let angle = F::select(far, c(FRAC_PI_4) + angle, angle);
    let angle = F::select(steep, c(FRAC_PI_2) - angle, angle);
    let angle = F::select(x.lt(c(0.0)), c(PI) - angle, angle);
    angle.copysign(y)
}
