//! [`Float`] for one f32 or f64, and [`Block`] for one f32.

use glam::Vec2;

use super::float::{Bits, Block, Float, LaneMask};

impl LaneMask for bool {
    const LANES: u32 = 1;

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        bits & 1 == 1
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self.into()
    }
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
}

macro_rules! scalars {
    ($($float:ident: $bits:ident { $($own:tt)* })*) => {$(
        impl Bits for $bits {
            #[inline(always)]
            fn splat(x: i32) -> Self {
                x.into()
            }
            #[inline(always)]
            fn wrapping_add(self, other: Self) -> Self {
                self.wrapping_add(other)
            }
            #[inline(always)]
            fn is_negative(self) -> Self {
                self >> (Self::BITS - 1)
            }
        }

        impl Float for $float {
            type Mask = bool;
            type Bits = $bits;

            #[inline(always)]
            fn splat(x: f32) -> Self {
                x.into()
            }
            #[inline(always)]
            fn constant(x: f64) -> Self {
                x as $float
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
                self.floor()
            }
            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                self.copysign(sign)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if self < other { self } else { other }
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if self > other { self } else { other }
            }
            #[inline(always)]
            fn lt(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn le(self, other: Self) -> bool {
                self <= other
            }
            #[inline(always)]
            fn eq(self, other: Self) -> bool {
                self == other
            }
            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
            #[inline(always)]
            fn to_bits(self) -> $bits {
                self.to_bits().cast_signed()
            }
            #[inline(always)]
            fn from_bits(bits: $bits) -> Self {
                Self::from_bits(bits.cast_unsigned())
            }
            $($own)*
        }
    )*};
}

scalars! {
    f32: i32 {}
    f64: i64 {
        #[inline(always)]
        fn unit_circle(self) -> [Self; 2] {
            let (sin, cos) = (std::f64::consts::TAU * self).sin_cos();
            [cos, sin]
        }
        #[inline(always)]
        fn atan2(self, x: Self) -> Self {
            self.atan2(x)
        }
    }
}

impl Block for f32 {
    const LANES: usize = 1;

    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        from[0]
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        to[0] = self;
    }
    #[inline(always)]
    fn load_pairs(from: &[Vec2]) -> [Self; 2] {
        from[0].to_array()
    }
    #[inline(always)]
    fn gather<'a>(record: impl Fn(usize) -> &'a [f32; 8]) -> [Self; 8] {
        *record(0)
    }
    #[inline(always)]
    fn gather4<'a>(record: impl Fn(usize) -> &'a [f32; 4]) -> [Self; 4] {
        *record(0)
    }
    #[inline(always)]
    fn scatter(rows: [Self; 8], to: &mut [[f32; 8]]) {
        to[0] = rows;
    }
    #[inline(always)]
    fn scatter4(rows: [Self; 4], to: &mut [[f32; 4]]) {
        to[0] = rows;
    }
}
