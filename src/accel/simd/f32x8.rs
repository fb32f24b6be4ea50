//! [`F32x8`]: a vector of eight f32 in one AVX2 register.

use std::arch::x86_64::*;

use super::lanes::{LaneIndices, Mask, Vector};

/// Eight f32 in one register. Exists only while code runs under `Avx2::call`: each `unsafe` below executes an
/// instruction that such a processor has.
#[derive(Clone, Copy)]
pub struct F32x8(pub(super) __m256);

/// Defines methods that take two vectors and are one instruction.
macro_rules! instructions {
    ($($name:ident = $instruction:ident;)*) => {$(
        #[inline(always)]
        fn $name(self, other: Self) -> Self {
            // SAFETY: the processor has AVX2, by the promise of the type.
            unsafe { Self($instruction(self.0, other.0)) }
        }
    )*};
}

impl Vector for F32x8 {
    const LANES: usize = 8;

    type Indices = Indices8;

    instructions! {
        add = _mm256_add_ps;
        sub = _mm256_sub_ps;
        mul = _mm256_mul_ps;
        div = _mm256_div_ps;
        min = _mm256_min_ps;
        max = _mm256_max_ps;
    }
    #[inline(always)]
    fn splat(x: f32) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_set1_ps(x)) }
    }
    #[inline(always)]
    unsafe fn load_unaligned(x: *const f32) -> Self {
        // SAFETY: as above; the caller promises that the numbers are readable.
        unsafe { Self(_mm256_loadu_ps(x)) }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0)) }
    }
    #[inline(always)]
    fn le(self, other: Self) -> Mask {
        // SAFETY: as above.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(self.0, other.0)) as Mask }
    }
    #[inline(always)]
    fn eq(self, other: Self) -> Mask {
        // SAFETY: as above.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_EQ_OQ>(self.0, other.0)) as Mask }
    }
    #[inline(always)]
    fn lane(self, lane: u32) -> f32 {
        // SAFETY: as above.
        unsafe {
            let lane = _mm256_castsi128_si256(_mm_cvtsi32_si128(lane as i32));
            _mm256_cvtss_f32(_mm256_permutevar8x32_ps(self.0, lane))
        }
    }
    #[inline(always)]
    fn permute(self, indices: Indices8) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_permutevar8x32_ps(self.0, indices.0)) }
    }
}

/// [`LaneIndices`] of the first eight lanes: in the lowest four bits of each lane, the bits above unspecified.
#[derive(Clone, Copy)]
pub struct Indices8(__m256i);

impl LaneIndices for Indices8 {
    #[inline(always)]
    fn unpack([even, odd]: [u32; 2]) -> Self {
        let words = u64::from(even) | u64::from(odd) << 32;
        // SAFETY: as above.
        unsafe {
            let shifts = _mm256_set_epi32(12, 12, 8, 8, 4, 4, 0, 0);
            Self(_mm256_srlv_epi32(_mm256_set1_epi64x(words as i64), shifts))
        }
    }
}
