//! [`Avx512`]: [`Lanes`] with AVX-512 instructions.

use std::arch::x86_64::*;
use std::ops::{Add, BitOr, BitXor, Div, Mul, Neg, Sub};

use glam::Vec2;

use super::avx2::Avx2;
use super::f32x8::F32x8;
use super::float::{Bits, Block, Float, LaneMask};
use super::lanes::{Kernel, LANES, LaneIndices, Lanes, Pick, Vector};

/// Sixteen f32 in one register. Only [`super::InstructionSet::run`] names this type, if [`Avx512::is_available`]: each
/// `unsafe` below executes an instruction that such a processor has.
#[derive(Clone, Copy)]
pub struct Avx512(__m512);

impl Avx512 {
    /// Whether the processor has all that [`Avx512::call`] is compiled for.
    pub fn is_available() -> bool {
        Avx2::is_available()
            && is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512dq")
    }
}

/// Defines methods that take one or two vectors and are one instruction.
macro_rules! instructions {
    ($($name:ident($($argument:ident),*) -> $result:ty = $instruction:expr;)*) => {$(
        #[inline(always)]
        fn $name(self, $($argument: Self),*) -> $result {
            // SAFETY: the processor has AVX-512, by the promise of the type.
            unsafe { $instruction(self.0, $($argument.0),*) }.into()
        }
    )*};
}

impl From<__m512> for Avx512 {
    #[inline(always)]
    fn from(x: __m512) -> Self {
        Self(x)
    }
}

impl Vector for Avx512 {
    type Indices = Indices512;

    #[inline(always)]
    fn lane(self, lane: u32) -> f32 {
        // SAFETY: as above.
        unsafe { _mm512_cvtss_f32(_mm512_permutexvar_ps(_mm512_set1_epi32(lane as i32), self.0)) }
    }
}

impl Pick<Self> for Avx512 {
    #[inline(always)]
    fn pick(self, indices: Indices512) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_permutexvar_ps(indices.0, self.0) })
    }
}

impl Lanes for Avx512 {
    type Narrow = Self;

    type Block = Self;

    type Boxes = F32x8;

    #[inline(always)]
    fn call<K: Kernel>(
        data: &K::Data,
        scratch: &mut K::Scratch,
        input: &K::Input,
        kernel: K,
    ) -> K::Output {
        #[inline(never)]
        #[target_feature(
            enable = "avx512f,avx512vl,avx512bw,avx512dq,avx2,fma,bmi1,bmi2,lzcnt,popcnt"
        )]
        fn with_features<K: Kernel>(
            data: &K::Data,
            scratch: &mut K::Scratch,
            input: &K::Input,
            kernel: K,
        ) -> K::Output {
            kernel.run::<Avx512>(input, data, scratch)
        }
        // SAFETY: the processor has AVX-512, by the promise of the type.
        unsafe { with_features(data, scratch, input, kernel) }
    }

    #[inline(always)]
    fn reduce_min(self) -> f32 {
        // SAFETY: as above.
        unsafe { _mm512_reduce_min_ps(self.0) }
    }
    #[inline(always)]
    fn reduce_min_max([a, b, c, d]: [Self; 4]) -> [[f32; 4]; 2] {
        let mut extremes = [0.0; LANES];
        // SAFETY: as above; the array has room for all lanes.
        unsafe {
            let least = reduce4(a.0, b.0, c.0, d.0, |a, b| _mm512_min_ps(a, b));
            let most = reduce4(a.0, b.0, c.0, d.0, |a, b| _mm512_max_ps(a, b));
            // Each quarter, for one of the vectors: two candidates for the smallest, two for the largest.
            let (low, high) =
                (_mm512_shuffle_ps::<0x44>(least, most), _mm512_shuffle_ps::<0xee>(least, most));
            let both = _mm512_mask_max_ps(_mm512_min_ps(low, high), 0xcccc, low, high);
            let other = _mm512_permute_ps::<0b10_11_00_01>(both);
            let both = _mm512_mask_max_ps(_mm512_min_ps(both, other), 0xcccc, both, other);
            _mm512_storeu_ps(extremes.as_mut_ptr(), both);
        }
        let of = |first: usize| {
            [extremes[first], extremes[first + 4], extremes[first + 8], extremes[first + 12]]
        };
        [of(0), of(2)]
    }
}

/// Transposes the 4 x 4 matrix in each quarter of four vectors.
#[inline(always)]
fn transpose4(a: __m512, b: __m512, c: __m512, d: __m512) -> [__m512; 4] {
    // SAFETY: as above.
    unsafe {
        let (ab, cd) = (_mm512_unpacklo_ps(a, b), _mm512_unpacklo_ps(c, d));
        let (ab2, cd2) = (_mm512_unpackhi_ps(a, b), _mm512_unpackhi_ps(c, d));
        [
            _mm512_shuffle_ps::<0x44>(ab, cd),
            _mm512_shuffle_ps::<0xee>(ab, cd),
            _mm512_shuffle_ps::<0x44>(ab2, cd2),
            _mm512_shuffle_ps::<0xee>(ab2, cd2),
        ]
    }
}

/// One record of eight numbers in the lower half, and another in the upper half.
///
/// # Safety
/// Eight numbers must be readable from each pointer on.
#[inline(always)]
unsafe fn pair(low: *const f32, high: *const f32) -> __m512 {
    // SAFETY: as above; the caller promises that the numbers are readable.
    unsafe {
        let low = _mm512_castps256_ps512(_mm256_loadu_ps(low));
        _mm512_insertf32x8::<1>(low, _mm256_loadu_ps(high))
    }
}

/// Four records of four numbers, one in each quarter.
#[inline(always)]
fn quarters(a: &[f32; 4], b: &[f32; 4], c: &[f32; 4], d: &[f32; 4]) -> __m512 {
    // SAFETY: as above; each record has four numbers.
    unsafe {
        let x = _mm512_castps128_ps512(_mm_loadu_ps(a.as_ptr()));
        let x = _mm512_insertf32x4::<1>(x, _mm_loadu_ps(b.as_ptr()));
        let x = _mm512_insertf32x4::<2>(x, _mm_loadu_ps(c.as_ptr()));
        _mm512_insertf32x4::<3>(x, _mm_loadu_ps(d.as_ptr()))
    }
}

/// The even quarters of both vectors, and the odd ones.
#[inline(always)]
fn deinterleave(a: __m512, b: __m512) -> [Avx512; 2] {
    // SAFETY: as above.
    unsafe {
        [Avx512(_mm512_shuffle_f32x4::<0x88>(a, b)), Avx512(_mm512_shuffle_f32x4::<0xdd>(a, b))]
    }
}

/// Reduces each vector to a quarter, whose lanes are `f` of the lanes of its four quarters, and puts those next to each
/// other.
#[inline(always)]
fn reduce4(
    a: __m512,
    b: __m512,
    c: __m512,
    d: __m512,
    f: impl Fn(__m512, __m512) -> __m512,
) -> __m512 {
    // SAFETY: as above.
    unsafe {
        // Two quarters of each vector: a, a, b, b and c, c, d, d.
        let ab = f(_mm512_shuffle_f32x4::<0x44>(a, b), _mm512_shuffle_f32x4::<0xee>(a, b));
        let cd = f(_mm512_shuffle_f32x4::<0x44>(c, d), _mm512_shuffle_f32x4::<0xee>(c, d));
        f(_mm512_shuffle_f32x4::<0x88>(ab, cd), _mm512_shuffle_f32x4::<0xdd>(ab, cd))
    }
}

/// [`LaneIndices`] in the lowest four bits of each lane, the bits above unspecified.
#[derive(Clone, Copy)]
pub struct Indices512(__m512i);

impl LaneIndices for Indices512 {
    #[inline(always)]
    fn unpack([even, odd]: [u32; 2]) -> Self {
        let words = u64::from(even) | u64::from(odd) << 32;
        // SAFETY: as above.
        unsafe {
            let shifts = _mm512_set_epi32(28, 28, 24, 24, 20, 20, 16, 16, 12, 12, 8, 8, 4, 4, 0, 0);
            Self(_mm512_srlv_epi32(_mm512_set1_epi64(words as i64), shifts))
        }
    }
}

impl LaneMask for __mmask16 {
    const LANES: u32 = 16;

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        bits as Self
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self.into()
    }
    #[inline(always)]
    fn any(self) -> bool {
        self != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        self == Self::MAX
    }
}

/// Sixteen i32.
#[derive(Clone, Copy)]
pub struct Bits16(__m512i);

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
    Avx512: Add::add = _mm512_add_ps;
    Avx512: Sub::sub = _mm512_sub_ps;
    Avx512: Mul::mul = _mm512_mul_ps;
    Avx512: Div::div = _mm512_div_ps;
    Bits16: BitOr::bitor = _mm512_or_si512;
    Bits16: BitXor::bitxor = _mm512_xor_si512;
}

impl Neg for Avx512 {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm512_xor_ps(_mm512_set1_ps(-0.0), self.0)) }
    }
}

impl Bits for Bits16 {
    #[inline(always)]
    fn splat(x: i32) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm512_set1_epi32(x)) }
    }
    #[inline(always)]
    fn wrapping_add(self, other: Self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm512_add_epi32(self.0, other.0)) }
    }
    #[inline(always)]
    fn is_negative(self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm512_srai_epi32::<31>(self.0)) }
    }
}

impl Float for Avx512 {
    type Mask = __mmask16;
    type Bits = Bits16;

    instructions! {
        min(other) -> Self = _mm512_min_ps;
        max(other) -> Self = _mm512_max_ps;
        abs() -> Self = _mm512_abs_ps;
        sqrt() -> Self = _mm512_sqrt_ps;
        floor() -> Self = _mm512_roundscale_ps::<{ _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC }>;
        lt(other) -> __mmask16 = _mm512_cmp_ps_mask::<_CMP_LT_OQ>;
        le(other) -> __mmask16 = _mm512_cmp_ps_mask::<_CMP_LE_OQ>;
        eq(other) -> __mmask16 = _mm512_cmp_ps_mask::<_CMP_EQ_OQ>;
    }
    #[inline(always)]
    fn splat(x: f32) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_set1_ps(x) })
    }
    #[inline(always)]
    fn constant(x: f64) -> Self {
        Self::splat(x as f32)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        // SAFETY: as above.
        unsafe {
            let bit = _mm512_set1_ps(-0.0);
            Self(_mm512_or_ps(_mm512_andnot_ps(bit, self.0), _mm512_and_ps(bit, sign.0)))
        }
    }
    #[inline(always)]
    fn select(mask: __mmask16, yes: Self, no: Self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm512_mask_mov_ps(no.0, mask, yes.0)) }
    }
    #[inline(always)]
    fn to_bits(self) -> Bits16 {
        // SAFETY: as above.
        unsafe { Bits16(_mm512_castps_si512(self.0)) }
    }
    #[inline(always)]
    fn from_bits(bits: Bits16) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm512_castsi512_ps(bits.0)) }
    }
}

impl Block for Avx512 {
    const LANES: usize = LANES;

    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        let from = &from[..LANES];
        // SAFETY: as above; there are sixteen numbers.
        unsafe { Self(_mm512_loadu_ps(from.as_ptr())) }
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        let to = &mut to[..LANES];
        // SAFETY: as above; there is room for sixteen numbers.
        unsafe { _mm512_storeu_ps(to.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn load_pairs(from: &[Vec2]) -> [Self; 2] {
        const { assert!(size_of::<Vec2>() == 2 * size_of::<f32>()) };
        let from: *const f32 = from[..LANES].as_ptr().cast();
        // SAFETY: as above; there are sixteen pairs of numbers (`Vec2` is `repr(C)`).
        unsafe {
            let (low, high) = (_mm512_loadu_ps(from), _mm512_loadu_ps(from.add(16)));
            let even = _mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0);
            let odd = _mm512_or_si512(even, _mm512_set1_epi32(1));
            [
                Self(_mm512_permutex2var_ps(low, even, high)),
                Self(_mm512_permutex2var_ps(low, odd, high)),
            ]
        }
    }
    #[inline(always)]
    fn gather<'a>(record: impl Fn(usize) -> &'a [f32; 8]) -> [Self; 8] {
        let at = |lane: usize| record(lane).as_ptr();
        // SAFETY: as above; each record has eight numbers.
        unsafe {
            // Records 0 to 3 beside 4 to 7, and 8 to 11 beside 12 to 15.
            let a = transpose4(
                pair(at(0), at(4)),
                pair(at(1), at(5)),
                pair(at(2), at(6)),
                pair(at(3), at(7)),
            );
            let b = transpose4(
                pair(at(8), at(12)),
                pair(at(9), at(13)),
                pair(at(10), at(14)),
                pair(at(11), at(15)),
            );
            let ([r0, r4], [r1, r5]) = (deinterleave(a[0], b[0]), deinterleave(a[1], b[1]));
            let ([r2, r6], [r3, r7]) = (deinterleave(a[2], b[2]), deinterleave(a[3], b[3]));
            [r0, r1, r2, r3, r4, r5, r6, r7]
        }
    }
    #[inline(always)]
    fn gather4<'a>(record: impl Fn(usize) -> &'a [f32; 4]) -> [Self; 4] {
        let [a, b, c, d] = transpose4(
            quarters(record(0), record(4), record(8), record(12)),
            quarters(record(1), record(5), record(9), record(13)),
            quarters(record(2), record(6), record(10), record(14)),
            quarters(record(3), record(7), record(11), record(15)),
        );
        [Self(a), Self(b), Self(c), Self(d)]
    }
    #[inline(always)]
    fn scatter([a, b, c, d, e, f, g, h]: [Self; 8], to: &mut [[f32; 8]]) {
        let to = &mut to[..LANES];
        // Quarter q of vector i: the first or last four numbers of record 4 q + i.
        let (first, last) = (transpose4(a.0, b.0, c.0, d.0), transpose4(e.0, f.0, g.0, h.0));
        for i in 0..4 {
            // SAFETY: as above; there is room for sixteen records of eight numbers.
            unsafe {
                let low = _mm512_shuffle_f32x4::<0x44>(first[i], last[i]);
                let high = _mm512_shuffle_f32x4::<0xee>(first[i], last[i]);
                // Now two quarters of each: 0, 1 of the first, 0, 1 of the last; and 2, 3.
                let low = _mm512_shuffle_f32x4::<0xd8>(low, low);
                let high = _mm512_shuffle_f32x4::<0xd8>(high, high);
                _mm256_storeu_ps(to[i].as_mut_ptr(), _mm512_castps512_ps256(low));
                _mm256_storeu_ps(to[i + 4].as_mut_ptr(), _mm512_extractf32x8_ps::<1>(low));
                _mm256_storeu_ps(to[i + 8].as_mut_ptr(), _mm512_castps512_ps256(high));
                _mm256_storeu_ps(to[i + 12].as_mut_ptr(), _mm512_extractf32x8_ps::<1>(high));
            }
        }
    }
    #[inline(always)]
    fn scatter4([a, b, c, d]: [Self; 4], to: &mut [[f32; 4]]) {
        let to = &mut to[..LANES];
        let rows = transpose4(a.0, b.0, c.0, d.0);
        for i in 0..4 {
            // SAFETY: as above; there is room for sixteen records of four numbers.
            unsafe {
                _mm_storeu_ps(to[i].as_mut_ptr(), _mm512_castps512_ps128(rows[i]));
                _mm_storeu_ps(to[i + 4].as_mut_ptr(), _mm512_extractf32x4_ps::<1>(rows[i]));
                _mm_storeu_ps(to[i + 8].as_mut_ptr(), _mm512_extractf32x4_ps::<2>(rows[i]));
                _mm_storeu_ps(to[i + 12].as_mut_ptr(), _mm512_extractf32x4_ps::<3>(rows[i]));
            }
        }
    }
}
