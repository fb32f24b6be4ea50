//! [`Float`] and [`Block`] for four f32: glam's [`Vec4`], which has the vectors of every target.

use std::ops::{BitOr, BitXor};

use glam::{BVec4A, Mat4, Vec2, Vec4};

use super::float::{Bits, Block, Float, LaneMask, four};

impl LaneMask for BVec4A {
    const LANES: u32 = 4;

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        Self::from_array(four(|i| bits >> i & 1 == 1))
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self.bitmask()
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.any()
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.all()
    }
}

/// Four i32, of which the compiler makes vectors.
#[derive(Clone, Copy)]
pub struct Bits4([i32; 4]);

macro_rules! operators {
    ($($trait:ident::$method:ident = $each:expr;)*) => {$(
        impl $trait for Bits4 {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let each = $each;
                Self(four(|i| each(self.0[i], other.0[i])))
            }
        }
    )*};
}

operators! {
    BitOr::bitor = |a: i32, b: i32| a | b;
    BitXor::bitxor = |a: i32, b: i32| a ^ b;
}

impl Bits for Bits4 {
    #[inline(always)]
    fn splat(x: i32) -> Self {
        Self([x; 4])
    }
    #[inline(always)]
    fn wrapping_add(self, other: Self) -> Self {
        Self(four(|i| self.0[i].wrapping_add(other.0[i])))
    }
    #[inline(always)]
    fn is_negative(self) -> Self {
        Self(four(|i| self.0[i] >> 31))
    }
}

impl Float for Vec4 {
    type Mask = BVec4A;
    type Bits = Bits4;

    #[inline(always)]
    fn splat(x: f32) -> Self {
        Self::splat(x)
    }
    #[inline(always)]
    fn constant(x: f64) -> Self {
        Self::splat(x as f32)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn floor(self) -> Self {
        // Without SSE4, glam's gives 0 for -0.
        self.floor().copysign(self)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        self.copysign(sign)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SSE has this rule for NaN; other targets have their own.
        if cfg!(target_arch = "x86_64") {
            self.min(other)
        } else {
            Self::select(self.cmplt(other), self, other)
        }
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if cfg!(target_arch = "x86_64") {
            self.max(other)
        } else {
            Self::select(self.cmpgt(other), self, other)
        }
    }
    #[inline(always)]
    fn lt(self, other: Self) -> BVec4A {
        self.cmplt(other)
    }
    #[inline(always)]
    fn le(self, other: Self) -> BVec4A {
        self.cmple(other)
    }
    #[inline(always)]
    fn eq(self, other: Self) -> BVec4A {
        self.cmpeq(other)
    }
    #[inline(always)]
    fn select(mask: BVec4A, yes: Self, no: Self) -> Self {
        Self::select(mask, yes, no)
    }
    #[inline(always)]
    fn to_bits(self) -> Bits4 {
        let x = self.to_array();
        Bits4(four(|i| x[i].to_bits().cast_signed()))
    }
    #[inline(always)]
    fn from_bits(Bits4(bits): Bits4) -> Self {
        Self::from_array(four(|i| f32::from_bits(bits[i].cast_unsigned())))
    }
}

impl Block for Vec4 {
    const LANES: usize = 4;

    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        Self::from_slice(from)
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        self.write_to_slice(to);
    }
    #[inline(always)]
    fn load_pairs(from: &[Vec2]) -> [Self; 2] {
        let from = &from[..4];
        [Self::from_array(four(|i| from[i].x)), Self::from_array(four(|i| from[i].y))]
    }
    #[inline(always)]
    fn gather<'a>(record: impl Fn(usize) -> &'a [f32; 8]) -> [Self; 8] {
        let half = |first: usize| transposed(four(|i| Self::from_slice(&record(i)[first..])));
        let ([a, b, c, d], [e, f, g, h]) = (half(0), half(4));
        [a, b, c, d, e, f, g, h]
    }
    #[inline(always)]
    fn gather4<'a>(record: impl Fn(usize) -> &'a [f32; 4]) -> [Self; 4] {
        transposed(four(|i| Self::from_array(*record(i))))
    }
    #[inline(always)]
    fn scatter([a, b, c, d, e, f, g, h]: [Self; 8], to: &mut [[f32; 8]]) {
        let to = &mut to[..4];
        for (first, rows) in [(0, [a, b, c, d]), (4, [e, f, g, h])] {
            let [a, b, c, d] = transposed(rows);
            a.write_to_slice(&mut to[0][first..]);
            b.write_to_slice(&mut to[1][first..]);
            c.write_to_slice(&mut to[2][first..]);
            d.write_to_slice(&mut to[3][first..]);
        }
    }
    #[inline(always)]
    fn scatter4(rows: [Self; 4], to: &mut [[f32; 4]]) {
        let to = &mut to[..4];
        let [a, b, c, d] = transposed(rows);
        (to[0], to[1], to[2], to[3]) = (a.to_array(), b.to_array(), c.to_array(), d.to_array());
    }
}

/// Vector i of the result has lane i of each vector.
#[inline(always)]
fn transposed([a, b, c, d]: [Vec4; 4]) -> [Vec4; 4] {
    let Mat4 { x_axis, y_axis, z_axis, w_axis } = Mat4::from_cols(a, b, c, d).transpose();
    [x_axis, y_axis, z_axis, w_axis]
}
