//! [`F32x8`]: a vector of eight f32 in one AVX2 register.

use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

use glam::Vec2;

use super::eight::{ARITY, Eight};
use super::float::{Bits, Block, Float, LaneMask, Mask};
use super::lanes::{LaneIndices, Pick, Vector};
use super::transpose::{pair, transpose4, transpose8};
use super::twice::Twice;

/// Eight f32 in one register. Exists only while code runs under `Avx2::call` or `Avx512::call`: each `unsafe` below executes an
/// instruction that such a processor has.
#[derive(Clone, Copy)]
pub struct F32x8(pub(super) __m256);

impl Vector for F32x8 {
    type Indices = Indices8;

    #[inline(always)]
    fn lane(self, lane: u32) -> f32 {
        // SAFETY: the processor has AVX2, by the promise of the type.
        unsafe {
            let lane = _mm256_castsi128_si256(_mm_cvtsi32_si128(lane as i32));
            _mm256_cvtss_f32(_mm256_permutevar8x32_ps(self.0, lane))
        }
    }
}

impl Pick<Self> for F32x8 {
    #[inline(always)]
    fn pick(self, indices: Indices8) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_permutevar8x32_ps(self.0, indices.0)) }
    }
}

impl Eight for F32x8 {
    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_fmadd_ps(self.0, factor.0, summand.0)) }
    }
    #[inline(always)]
    fn compress(self, mask: Mask) -> Self {
        let lanes = &LANES_OF[mask as usize % LANES_OF.len()];
        // SAFETY: as above; each entry has eight bytes.
        unsafe {
            let lanes = _mm256_cvtepu8_epi32(_mm_loadl_epi64(lanes.as_ptr().cast()));
            Self(_mm256_permutevar8x32_ps(self.0, lanes))
        }
    }
    #[inline(always)]
    fn largest_first(mask: Mask8, ids: Self, keys: Self) -> ([Self; 2], usize) {
        // SAFETY: as above.
        unsafe {
            // The number of its lane in the lowest bits of each key. No number but -∞ becomes NaN by that.
            let lanes = _mm256_castsi256_ps(_mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0));
            let bits = _mm256_castsi256_ps(_mm256_set1_epi32(ARITY as i32 - 1));
            let finite = _mm256_min_ps(keys.0, _mm256_set1_ps(f32::MAX));
            let tagged = _mm256_or_ps(_mm256_andnot_ps(bits, finite), lanes);
            let x = _mm256_blendv_ps(_mm256_set1_ps(f32::MAX), tagged, mask.0);
            let x = _mm_min_ps(_mm256_castps256_ps128(x), _mm256_extractf128_ps::<1>(x));
            let x = _mm_min_ps(x, _mm_permute_ps::<0b01_00_11_10>(x));
            let x = _mm_min_ps(x, _mm_permute_ps::<0b10_11_00_01>(x));
            let last = _mm_cvtsi128_si32(_mm_castps_si128(x)) as usize % ARITY;
            let x = _mm256_blendv_ps(_mm256_set1_ps(f32::MIN), tagged, mask.0);
            // A bitonic network: in each step lanes that are paired exchange their keys, the larger one going down.
            let x = exchange::<0b1010_1010>(x, _mm256_permute_ps::<0b10_11_00_01>(x));
            let x = exchange::<0b1100_1100>(x, _mm256_permute_ps::<0b00_01_10_11>(x));
            let x = exchange::<0b1010_1010>(x, _mm256_permute_ps::<0b10_11_00_01>(x));
            let reversed = _mm256_permute_ps::<0b00_01_10_11>(x);
            let x = exchange::<0b1111_0000>(x, _mm256_permute2f128_ps::<1>(reversed, reversed));
            let x = exchange::<0b1100_1100>(x, _mm256_permute_ps::<0b01_00_11_10>(x));
            let x = exchange::<0b1010_1010>(x, _mm256_permute_ps::<0b10_11_00_01>(x));
            // Of an index, the lowest three bits count.
            let order = _mm256_castps_si256(x);
            let ids = Self(_mm256_permutevar8x32_ps(ids.0, order));
            ([ids, Self(_mm256_permutevar8x32_ps(keys.0, order))], last)
        }
    }
}

/// The smaller of two numbers in the lanes of `UPPER`, the larger in others.
#[inline(always)]
fn exchange<const UPPER: i32>(x: __m256, other: __m256) -> __m256 {
    // SAFETY: as above.
    unsafe { _mm256_blend_ps::<UPPER>(_mm256_max_ps(x, other), _mm256_min_ps(x, other)) }
}

/// The lanes of each mask, lowest first, then zeros.
static LANES_OF: [[u8; 8]; 256] = {
    let mut lanes = [[0; 8]; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut bit, mut len) = (0, 0);
        while bit < 8 {
            if mask >> bit & 1 == 1 {
                lanes[mask][len] = bit as u8;
                len += 1;
            }
            bit += 1;
        }
        mask += 1;
    }
    lanes
};

/// Which lanes of an [`F32x8`] satisfy a condition: all bits set, or none.
#[derive(Clone, Copy)]
pub struct Mask8(__m256);

/// Eight i32.
#[derive(Clone, Copy)]
pub struct Bits8(__m256i);

/// Defines operators that are one instruction.
macro_rules! operators {
    ($($type:ident: $trait:ident::$method:ident = $instruction:ident;)*) => {$(
        impl $trait for $type {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: as above.
                unsafe { Self($instruction(self.0, other.0)) }
            }
        }
    )*};
}

operators! {
    F32x8: Add::add = _mm256_add_ps;
    F32x8: Sub::sub = _mm256_sub_ps;
    F32x8: Mul::mul = _mm256_mul_ps;
    F32x8: Div::div = _mm256_div_ps;
    Mask8: BitAnd::bitand = _mm256_and_ps;
    Mask8: BitOr::bitor = _mm256_or_ps;
    Mask8: BitXor::bitxor = _mm256_xor_ps;
    Bits8: BitOr::bitor = _mm256_or_si256;
    Bits8: BitXor::bitxor = _mm256_xor_si256;
}

impl Neg for F32x8 {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_xor_ps(_mm256_set1_ps(-0.0), self.0)) }
    }
}

impl Not for Mask8 {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        self ^ Self::splat(true)
    }
}

impl LaneMask for Mask8 {
    const LANES: u32 = 8;

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        // SAFETY: as above.
        unsafe {
            let lanes = _mm256_set_epi32(128, 64, 32, 16, 8, 4, 2, 1);
            let chosen = _mm256_and_si256(_mm256_set1_epi32(bits as i32), lanes);
            Self(_mm256_castsi256_ps(_mm256_cmpeq_epi32(chosen, lanes)))
        }
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        // SAFETY: as above.
        unsafe { _mm256_movemask_ps(self.0) as u32 }
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.bits() == 0xff
    }
}

impl Bits for Bits8 {
    #[inline(always)]
    fn splat(x: i32) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_set1_epi32(x)) }
    }
    #[inline(always)]
    fn wrapping_add(self, other: Self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_add_epi32(self.0, other.0)) }
    }
    #[inline(always)]
    fn is_negative(self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_srai_epi32::<31>(self.0)) }
    }
}

/// Defines methods that take two vectors and are one instruction.
macro_rules! methods {
    ($($name:ident -> $result:ident = $instruction:expr;)*) => {$(
        #[inline(always)]
        fn $name(self, other: Self) -> $result {
            // SAFETY: as above.
            unsafe { $result($instruction(self.0, other.0)) }
        }
    )*};
}

impl Float for F32x8 {
    type Mask = Mask8;
    type Bits = Bits8;

    methods! {
        min -> F32x8 = _mm256_min_ps;
        max -> F32x8 = _mm256_max_ps;
        lt -> Mask8 = _mm256_cmp_ps::<_CMP_LT_OQ>;
        le -> Mask8 = _mm256_cmp_ps::<_CMP_LE_OQ>;
        eq -> Mask8 = _mm256_cmp_ps::<_CMP_EQ_OQ>;
    }
    #[inline(always)]
    fn splat(x: f32) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_set1_ps(x)) }
    }
    #[inline(always)]
    fn constant(x: f64) -> Self {
        Self::splat(x as f32)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_sqrt_ps(self.0)) }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0)) }
    }
    #[inline(always)]
    fn floor(self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_floor_ps(self.0)) }
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        // SAFETY: as above.
        unsafe {
            let bit = _mm256_set1_ps(-0.0);
            Self(_mm256_or_ps(_mm256_andnot_ps(bit, self.0), _mm256_and_ps(bit, sign.0)))
        }
    }
    #[inline(always)]
    fn select(mask: Mask8, yes: Self, no: Self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_blendv_ps(no.0, yes.0, mask.0)) }
    }
    #[inline(always)]
    fn to_bits(self) -> Bits8 {
        // SAFETY: as above.
        unsafe { Bits8(_mm256_castps_si256(self.0)) }
    }
    #[inline(always)]
    fn from_bits(bits: Bits8) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_castsi256_ps(bits.0)) }
    }
}

impl Block for F32x8 {
    const LANES: usize = 8;

    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        let from = &from[..8];
        // SAFETY: as above; there are eight numbers.
        unsafe { Self(_mm256_loadu_ps(from.as_ptr())) }
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        let to = &mut to[..8];
        // SAFETY: as above; there is room for eight numbers.
        unsafe { _mm256_storeu_ps(to.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn load_pairs(from: &[Vec2]) -> [Self; 2] {
        const { assert!(size_of::<Vec2>() == 2 * size_of::<f32>()) };
        let from: *const f32 = from[..8].as_ptr().cast();
        // SAFETY: as above; there are eight pairs of numbers (`Vec2` is `repr(C)`).
        unsafe {
            let (low, high) = (_mm256_loadu_ps(from), _mm256_loadu_ps(from.add(8)));
            // Pairs 0, 1, 4, 5 and 2, 3, 6, 7.
            let even = _mm256_permute2f128_ps::<0x20>(low, high);
            let odd = _mm256_permute2f128_ps::<0x31>(low, high);
            [Self(_mm256_shuffle_ps::<0x88>(even, odd)), Self(_mm256_shuffle_ps::<0xdd>(even, odd))]
        }
    }
    #[inline(always)]
    fn gather<'a>(record: impl Fn(usize) -> &'a [f32; 8]) -> [Self; 8] {
        let at = |lane: usize| record(lane).as_ptr();
        // SAFETY: as above; each record has eight numbers.
        let rows = unsafe { transpose8([at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)]) };
        let [a, b, c, d, e, f, g, h] = rows;
        [Self(a), Self(b), Self(c), Self(d), Self(e), Self(f), Self(g), Self(h)]
    }
    #[inline(always)]
    fn gather4<'a>(record: impl Fn(usize) -> &'a [f32; 4]) -> [Self; 4] {
        let at = |lane: usize| record(lane).as_ptr();
        // SAFETY: as above; each record has four numbers.
        let [a, b, c, d] = unsafe {
            transpose4(
                pair(at(0), at(4)),
                pair(at(1), at(5)),
                pair(at(2), at(6)),
                pair(at(3), at(7)),
            )
        };
        [Self(a), Self(b), Self(c), Self(d)]
    }
    #[inline(always)]
    fn scatter(rows: [Self; 8], to: &mut [[f32; 8]]) {
        let to = &mut to[..8];
        let [a, b, c, d, e, f, g, h] = rows;
        // SAFETY: as above; there is room for eight records of eight numbers.
        unsafe {
            let low = transpose4(a.0, b.0, c.0, d.0);
            let high = transpose4(e.0, f.0, g.0, h.0);
            for i in 0..4 {
                let first = _mm256_permute2f128_ps::<0x20>(low[i], high[i]);
                let fifth = _mm256_permute2f128_ps::<0x31>(low[i], high[i]);
                _mm256_storeu_ps(to[i].as_mut_ptr(), first);
                _mm256_storeu_ps(to[i + 4].as_mut_ptr(), fifth);
            }
        }
    }
    #[inline(always)]
    fn scatter4([a, b, c, d]: [Self; 4], to: &mut [[f32; 4]]) {
        let to = &mut to[..8];
        // SAFETY: as above; there is room for eight records of four numbers.
        unsafe {
            let rows = transpose4(a.0, b.0, c.0, d.0);
            for i in 0..4 {
                _mm_storeu_ps(to[i].as_mut_ptr(), _mm256_castps256_ps128(rows[i]));
                _mm_storeu_ps(to[i + 4].as_mut_ptr(), _mm256_extractf128_ps::<1>(rows[i]));
            }
        }
    }
}

/// [`LaneIndices`] of eight lanes: in the lowest four bits of each, the bits above unspecified.
#[derive(Clone, Copy)]
pub struct Indices8(pub(super) __m256i);

impl LaneIndices for Indices8 {
    #[inline(always)]
    fn unpack(words: [u32; 2]) -> Self {
        Twice::unpack(words).0
    }
}

impl LaneIndices for Twice<Indices8> {
    #[inline(always)]
    fn unpack([even, odd]: [u32; 2]) -> Self {
        let words = u64::from(even) | u64::from(odd) << 32;
        // SAFETY: as above.
        unsafe {
            let words = _mm256_set1_epi64x(words as i64);
            let low = _mm256_set_epi32(12, 12, 8, 8, 4, 4, 0, 0);
            let high = _mm256_set_epi32(28, 28, 24, 24, 20, 20, 16, 16);
            Self(Indices8(_mm256_srlv_epi32(words, low)), Indices8(_mm256_srlv_epi32(words, high)))
        }
    }
}
