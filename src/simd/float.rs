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
    Copy + BitAnd<Output = Self> + BitOr<Output = Self> + BitXor<Output = Self> + Not<Output = Self>
{
    /// All lanes, or none.
    fn splat(is: bool) -> Self;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{BlockKernel, InstructionSet};

    /// Sixteen pairs of numbers at a time, through every operation.
    struct Everything<'a> {
        a: &'a [f32; 16],
        b: &'a [f32; 16],
    }

    /// The bits of every operation in every lane, one row for each.
    type Results = Vec<[u32; 16]>;

    impl BlockKernel for Everything<'_> {
        type Output = Results;

        #[inline(always)]
        fn run<F: Block>(self) -> Results {
            let mut all = Vec::new();
            for at in (0..16).step_by(F::LANES) {
                let (a, b) = (F::load(&self.a[at..]), F::load(&self.b[at..]));
                let mask = |mask: F::Mask| F::select(mask, a, b);
                let bits = |x: F::Bits| F::from_bits(x);
                let pairs: [Vec2; 16] = std::array::from_fn(|i| Vec2::new(self.a[i], self.b[i]));
                let [first, second] = F::load_pairs(&pairs[at..]);
                let mut eights = [[0.0; 8]; 16];
                let mut fours = [[0.0; 4]; 16];
                F::scatter([a, b, a + b, a - b, b - a, a * b, b, a], &mut eights);
                F::scatter4([b, a, a * b, a], &mut fours);
                let [e0, e1, e2, e3, e4, e5, e6, e7] = F::gather(|lane| &eights[lane]);
                let [f0, f1, f2, f3] = F::gather4(|lane| &fours[lane]);
                let rows = [
                    a + b,
                    a - b,
                    a * b,
                    a / b,
                    -a,
                    a.sqrt(),
                    a.abs(),
                    a.floor(),
                    a.copysign(b),
                    a.min(b),
                    a.max(b),
                    mask(a.lt(b)),
                    mask(a.le(b)),
                    mask(a.gt(b)),
                    mask(a.ge(b)),
                    mask(a.eq(b)),
                    mask(!a.lt(b) & a.le(b)),
                    mask(a.lt(b) | b.lt(a)),
                    mask(a.lt(b) ^ a.le(b)),
                    mask(F::Mask::splat(true)),
                    mask(F::Mask::splat(false)),
                    F::splat(0.1),
                    F::constant(0.1),
                    bits(a.to_bits() + F::Bits::splat(3)),
                    bits(a.to_bits() ^ b.to_bits()),
                    bits(a.to_bits() | b.to_bits()),
                    bits(a.to_bits().is_negative()),
                    a.abs().min(F::splat(1.0)).unit_circle()[0],
                    a.abs().min(F::splat(1.0)).unit_circle()[1],
                    a.atan2(b),
                    first,
                    second,
                    e0,
                    e1,
                    e2,
                    e3,
                    e4,
                    e5,
                    e6,
                    e7,
                    f0,
                    f1,
                    f2,
                    f3,
                ];
                let masks = [a.lt(b), a.eq(a)];
                let tell = |i: usize| {
                    let mask = masks[i];
                    let lanes = (1_u64 << F::LANES) - 1;
                    assert_eq!(mask.any(), mask.bits() != 0);
                    assert_eq!(mask.all(), u64::from(mask.bits()) == lanes);
                    F::select(mask, F::splat(1.0), F::splat(0.0))
                };
                let (x, y) = (tell(0), tell(1));
                all.resize(rows.len() + 4, [0; 16]);
                for (row, number) in all.iter_mut().zip(rows.into_iter().chain([x, y])) {
                    let mut numbers = [0.0; 16];
                    number.store(&mut numbers);
                    for lane in 0..F::LANES {
                        row[at + lane] = numbers[lane].to_bits();
                    }
                }
                for (row, mask) in all[rows.len() + 2..].iter_mut().zip(masks) {
                    for lane in 0..F::LANES {
                        row[at + lane] = mask.bits() >> lane & 1;
                    }
                }
            }
            all
        }
    }

    /// One NaN is like another: its sign and its payload are the processor's.
    fn one_nan(mut results: Results) -> Results {
        for bits in results.iter_mut().flatten() {
            if f32::from_bits(*bits).is_nan() {
                *bits = f32::NAN.to_bits();
            }
        }
        results
    }

    /// All pairs of numbers of all kinds, by every instruction set and by single f32. Seen to fail with exchanged operands of
    /// `min`, with a rounding that is not down, and with two quarters of a transposed matrix exchanged.
    #[test]
    fn every_instruction_set_gives_the_bits_of_f32() {
        let numbers = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            0.5,
            -2.75,
            1e-45,
            -1e-45,
            f32::MIN_POSITIVE,
            3.4e38,
            -3.4e38,
            1e10,
            f32::INFINITY,
            f32::NEG_INFINITY,
            f32::NAN,
            0.3,
            7.999_999_5,
            -8.5,
        ];
        let pairs: Vec<[f32; 2]> =
            numbers.into_iter().flat_map(|a| numbers.map(|b| [a, b])).collect();
        for (trial, pairs) in pairs.chunks_exact(16).enumerate() {
            let a: [f32; 16] = std::array::from_fn(|i| pairs[i][0]);
            let b: [f32; 16] = std::array::from_fn(|i| pairs[i][1]);
            let expected = one_nan(Everything { a: &a, b: &b }.run::<f32>());
            for set in InstructionSet::available() {
                let found = one_nan(set.run_block(Everything { a: &a, b: &b }));
                for (row, (found, expected)) in found.iter().zip(&expected).enumerate() {
                    assert_eq!(
                        found, expected,
                        "{set}, trial {trial}, operation {row}: {a:?}, {b:?}"
                    );
                }
            }
        }
    }
}
