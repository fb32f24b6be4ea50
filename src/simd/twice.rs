//! [`Twice`]: a pair of vectors is a vector of twice as many lanes.

use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

use glam::Vec2;

use super::float::{Bits, Block, Float, LaneMask};

/// The lower and the upper half: of numbers, of a mask, or of bits.
#[derive(Clone, Copy)]
pub struct Twice<T>(pub(super) T, pub(super) T);

macro_rules! operators {
    ($($trait:ident::$method:ident($($other:ident)?);)*) => {$(
        impl<T: $trait<Output = T>> $trait for Twice<T> {
            type Output = Self;

            #[inline(always)]
            fn $method(self $(, $other: Self)?) -> Self {
                Self(self.0.$method($($other.0)?), self.1.$method($($other.1)?))
            }
        }
    )*};
}

operators! {
    Add::add(other);
    Sub::sub(other);
    Mul::mul(other);
    Div::div(other);
    Neg::neg();
    BitAnd::bitand(other);
    BitOr::bitor(other);
    BitXor::bitxor(other);
    Not::not();
}

/// Defines methods that do the same with both halves.
macro_rules! methods {
    ($($name:ident($($other:ident)?) -> $result:ty;)*) => {$(
        #[inline(always)]
        fn $name(self $(, $other: Self)?) -> $result {
            Twice(self.0.$name($($other.0)?), self.1.$name($($other.1)?))
        }
    )*};
}

impl<M: LaneMask> LaneMask for Twice<M> {
    const LANES: u32 = 2 * M::LANES;

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        Self(M::from_bits(bits), M::from_bits(bits >> M::LANES))
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.bits() | self.1.bits() << M::LANES
    }
    #[inline(always)]
    fn any(self) -> bool {
        (self.0 | self.1).any()
    }
    #[inline(always)]
    fn all(self) -> bool {
        (self.0 & self.1).all()
    }
}

impl<B: Bits> Bits for Twice<B> {
    methods! {
        is_negative() -> Self;
        wrapping_add(other) -> Self;
    }
    #[inline(always)]
    fn splat(x: i32) -> Self {
        Self(B::splat(x), B::splat(x))
    }
}

impl<F: Float> Float for Twice<F> {
    type Mask = Twice<F::Mask>;
    type Bits = Twice<F::Bits>;

    methods! {
        sqrt() -> Self;
        abs() -> Self;
        floor() -> Self;
        copysign(sign) -> Self;
        min(other) -> Self;
        max(other) -> Self;
        lt(other) -> Self::Mask;
        le(other) -> Self::Mask;
        eq(other) -> Self::Mask;
        to_bits() -> Self::Bits;
    }
    #[inline(always)]
    fn splat(x: f32) -> Self {
        Self(F::splat(x), F::splat(x))
    }
    #[inline(always)]
    fn constant(x: f64) -> Self {
        Self(F::constant(x), F::constant(x))
    }
    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self(F::select(mask.0, yes.0, no.0), F::select(mask.1, yes.1, no.1))
    }
    #[inline(always)]
    fn from_bits(bits: Self::Bits) -> Self {
        Self(F::from_bits(bits.0), F::from_bits(bits.1))
    }
}

impl<F: Block> Block for Twice<F> {
    const LANES: usize = 2 * F::LANES;

    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        Self(F::load(from), F::load(&from[F::LANES..]))
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        self.0.store(to);
        self.1.store(&mut to[F::LANES..]);
    }
    #[inline(always)]
    fn load_pairs(from: &[Vec2]) -> [Self; 2] {
        let ([a, b], [c, d]) = (F::load_pairs(from), F::load_pairs(&from[F::LANES..]));
        [Self(a, c), Self(b, d)]
    }
    #[inline(always)]
    fn gather<'a>(record: impl Fn(usize) -> &'a [f32; 8]) -> [Self; 8] {
        paired(F::gather(&record), F::gather(|i| record(F::LANES + i)))
    }
    #[inline(always)]
    fn gather4<'a>(record: impl Fn(usize) -> &'a [f32; 4]) -> [Self; 4] {
        paired(F::gather4(&record), F::gather4(|i| record(F::LANES + i)))
    }
    #[inline(always)]
    fn scatter(rows: [Self; 8], to: &mut [[f32; 8]]) {
        let (low, high) = halves(rows);
        F::scatter(low, to);
        F::scatter(high, &mut to[F::LANES..]);
    }
    #[inline(always)]
    fn scatter4(rows: [Self; 4], to: &mut [[f32; 4]]) {
        let (low, high) = halves(rows);
        F::scatter4(low, to);
        F::scatter4(high, &mut to[F::LANES..]);
    }
}

#[inline(always)]
fn paired<T: Copy, const N: usize>(low: [T; N], high: [T; N]) -> [Twice<T>; N] {
    let mut both = [Twice(low[0], high[0]); N];
    for i in 1..N {
        both[i] = Twice(low[i], high[i]);
    }
    both
}

#[inline(always)]
fn halves<T: Copy, const N: usize>(both: [Twice<T>; N]) -> ([T; N], [T; N]) {
    let (mut low, mut high) = ([both[0].0; N], [both[0].1; N]);
    for i in 1..N {
        (low[i], high[i]) = (both[i].0, both[i].1);
    }
    (low, high)
}
