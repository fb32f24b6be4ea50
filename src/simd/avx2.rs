//! [`Avx2`]: [`Lanes`] with AVX2 instructions.

use std::arch::x86_64::*;

use super::f32x8::F32x8;
use super::lanes::{Kernel, LANES, LaneIndices, Lanes, Mask, Vector};
use super::mask_tables::{compress, flipped};
use super::transpose::transpose8;

/// Sixteen f32 in two registers. Only [`super::InstructionSet::run`] names this type, if [`Avx2::is_available`]: each
/// `unsafe` below executes an instruction that such a processor has.
#[derive(Clone, Copy)]
pub struct Avx2(__m256, __m256);

impl Avx2 {
    /// Whether the processor has all that [`Avx2::call`] is compiled for.
    pub fn is_available() -> bool {
        is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("bmi2")
            && is_x86_feature_detected!("lzcnt")
            && is_x86_feature_detected!("popcnt")
    }
}

/// Defines methods that take two vectors and are one instruction for each half.
macro_rules! instructions {
    ($($name:ident = $instruction:ident;)*) => {$(
        #[inline(always)]
        fn $name(self, other: Self) -> Self {
            // SAFETY: the processor has AVX2, by the promise of the type.
            unsafe { Self($instruction(self.0, other.0), $instruction(self.1, other.1)) }
        }
    )*};
}

/// Defines comparisons, which give a mask.
macro_rules! comparisons {
    ($($name:ident = $kind:ident;)*) => {$(
        #[inline(always)]
        fn $name(self, other: Self) -> Mask {
            // SAFETY: as above.
            unsafe {
                let low = _mm256_movemask_ps(_mm256_cmp_ps::<$kind>(self.0, other.0));
                let high = _mm256_movemask_ps(_mm256_cmp_ps::<$kind>(self.1, other.1));
                (low | high << 8) as Mask
            }
        }
    )*};
}

impl Vector for Avx2 {
    const LANES: usize = LANES;

    type Indices = Indices256;

    instructions! {
        add = _mm256_add_ps;
        sub = _mm256_sub_ps;
        mul = _mm256_mul_ps;
        div = _mm256_div_ps;
        min = _mm256_min_ps;
        max = _mm256_max_ps;
    }
    comparisons! {
        le = _CMP_LE_OQ;
        eq = _CMP_EQ_OQ;
    }
    #[inline(always)]
    fn splat(x: f32) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_set1_ps(x), _mm256_set1_ps(x)) }
    }
    #[inline(always)]
    unsafe fn load_unaligned(x: *const f32) -> Self {
        // SAFETY: as above; the caller promises that the numbers are readable.
        unsafe { Self(_mm256_loadu_ps(x), _mm256_loadu_ps(x.add(8))) }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: as above.
        unsafe {
            let sign = _mm256_set1_ps(-0.0);
            Self(_mm256_andnot_ps(sign, self.0), _mm256_andnot_ps(sign, self.1))
        }
    }
    #[inline(always)]
    fn lane(self, lane: u32) -> f32 {
        // SAFETY: as above.
        unsafe { _mm256_cvtss_f32(self.broadcast(lane).0) }
    }
    #[inline(always)]
    fn permute(self, indices: Indices256) -> Self {
        Self(permute(self, indices.0), permute(self, indices.1))
    }
}

impl Lanes for Avx2 {
    type Narrow = F32x8;

    type Block = F32x8;

    const USES_PACKETS: bool = true;

    const SKIPS_EMPTY: bool = true;

    #[inline(always)]
    fn call<K: Kernel>(
        data: &K::Data,
        scratch: &mut K::Scratch,
        input: &K::Input,
        kernel: K,
    ) -> K::Output {
        #[inline(never)]
        #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
        fn with_features<K: Kernel>(
            data: &K::Data,
            scratch: &mut K::Scratch,
            input: &K::Input,
            kernel: K,
        ) -> K::Output {
            kernel.run::<Avx2>(input, data, scratch)
        }
        // SAFETY: the processor has AVX2, by the promise of the type.
        unsafe { with_features(data, scratch, input, kernel) }
    }

    comparisons! {
        lt = _CMP_LT_OQ;
    }
    #[inline(always)]
    fn load(x: &[f32; LANES]) -> Self {
        // SAFETY: the array has all lanes.
        unsafe { Self::load_unaligned(x.as_ptr()) }
    }
    #[inline(always)]
    fn transpose(records: &[[f32; 8]; LANES]) -> [Self; 8] {
        let at = |i: usize| records[i].as_ptr();
        // SAFETY: as above; each record has eight numbers.
        let (low, high) = unsafe {
            (
                transpose8([at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)]),
                transpose8([at(8), at(9), at(10), at(11), at(12), at(13), at(14), at(15)]),
            )
        };
        let both = |i: usize| Self(low[i], high[i]);
        [both(0), both(1), both(2), both(3), both(4), both(5), both(6), both(7)]
    }
    #[inline(always)]
    fn to_array(self) -> [f32; LANES] {
        let mut x = [0.0; LANES];
        // SAFETY: as above; the array has room for all lanes.
        unsafe {
            _mm256_storeu_ps(x.as_mut_ptr(), self.0);
            _mm256_storeu_ps(x.as_mut_ptr().add(8), self.1);
        }
        x
    }
    #[inline(always)]
    fn blend(self, mask: Mask, other: Self) -> Self {
        // SAFETY: as above.
        unsafe {
            Self(
                _mm256_blendv_ps(self.0, other.0, all_bits(mask)),
                _mm256_blendv_ps(self.1, other.1, all_bits(mask >> 8)),
            )
        }
    }
    #[inline(always)]
    fn reduce_min(self) -> f32 {
        // SAFETY: as above.
        unsafe {
            let eight = _mm256_min_ps(self.0, self.1);
            let four = _mm_min_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps::<1>(eight));
            let two = _mm_min_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_min_ss(two, _mm_movehdup_ps(two)))
        }
    }
    #[inline(always)]
    fn reduce_max(self) -> f32 {
        // SAFETY: as above.
        unsafe {
            let eight = _mm256_max_ps(self.0, self.1);
            let four = _mm_max_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps::<1>(eight));
            let two = _mm_max_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_max_ss(two, _mm_movehdup_ps(two)))
        }
    }
    #[inline(always)]
    fn broadcast(self, lane: u32) -> Self {
        let half = if lane < 8 { self.0 } else { self.1 };
        // SAFETY: as above.
        unsafe {
            let all = _mm256_permutevar8x32_ps(half, _mm256_set1_epi32(lane as i32));
            Self(all, all)
        }
    }
    #[inline(always)]
    fn broadcast_narrow(self, lane: u32) -> F32x8 {
        F32x8(self.broadcast(lane).0)
    }
    #[inline(always)]
    fn flip(self, _flip: u32) -> Self {
        self
    }
    #[inline(always)]
    fn flip_mask(mask: Mask, flip: u32) -> Mask {
        flipped(mask, flip)
    }
    #[inline(always)]
    fn compress_children(
        self,
        mask: Mask,
        children: &[u32; LANES],
        flip: u32,
        ids: &mut [u32; LANES],
        distances: &mut [f32; LANES],
    ) {
        // SAFETY: as above; the array has all lanes.
        let children = unsafe {
            let children = children.as_ptr();
            [_mm256_loadu_si256(children.cast()), _mm256_loadu_si256(children.add(8).cast())]
        };
        compress(mask, flip, children, [self.0, self.1], ids, distances);
    }
    #[inline(always)]
    fn compress_slots(
        self,
        mask: Mask,
        first: u32,
        flip: u32,
        ids: &mut [u32; LANES],
        distances: &mut [f32; LANES],
    ) {
        // SAFETY: as above.
        let slots = unsafe {
            let low = _mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0);
            let from = |first: u32| _mm256_add_epi32(low, _mm256_set1_epi32(first as i32));
            [from(first), from(first + 8)]
        };
        compress(mask, flip, slots, [self.0, self.1], ids, distances);
    }
}

/// All bits set in the lanes of the lower half of a mask, none in the others.
#[inline(always)]
fn all_bits(mask: Mask) -> __m256 {
    // SAFETY: as above.
    unsafe {
        let bits = _mm256_set_epi32(128, 64, 32, 16, 8, 4, 2, 1);
        let chosen = _mm256_and_si256(_mm256_set1_epi32(i32::from(mask)), bits);
        _mm256_castsi256_ps(_mm256_cmpeq_epi32(chosen, bits))
    }
}

/// [`LaneIndices`] in the lowest four bits of each lane, the bits above unspecified.
#[derive(Clone, Copy)]
pub struct Indices256(__m256i, __m256i);

impl LaneIndices for Indices256 {
    #[inline(always)]
    fn unpack([even, odd]: [u32; 2]) -> Self {
        let words = u64::from(even) | u64::from(odd) << 32;
        // SAFETY: as above.
        unsafe {
            let words = _mm256_set1_epi64x(words as i64);
            let low = _mm256_set_epi32(12, 12, 8, 8, 4, 4, 0, 0);
            let high = _mm256_set_epi32(28, 28, 24, 24, 20, 20, 16, 16);
            Self(_mm256_srlv_epi32(words, low), _mm256_srlv_epi32(words, high))
        }
    }
}

/// Picks eight lanes of sixteen by the lowest four bits of each index.
#[inline(always)]
fn permute(from: Avx2, indices: __m256i) -> __m256 {
    // SAFETY: as above.
    unsafe {
        let low = _mm256_permutevar8x32_ps(from.0, indices);
        let high = _mm256_permutevar8x32_ps(from.1, indices);
        // The fourth bit, moved to the sign, picks the half.
        _mm256_blendv_ps(low, high, _mm256_castsi256_ps(_mm256_slli_epi32::<28>(indices)))
    }
}
