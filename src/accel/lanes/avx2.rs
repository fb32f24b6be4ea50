//! [`Lanes`] in the instructions of AVX2.

use std::arch::x86_64::*;

use super::columns::columns;
use super::eight::Eight;
use super::halves::{flipped, push};
use super::{LANES, Lanes, Mask, Places, Vector};
use crate::accel::stack::Stack;
use crate::geometry::Ray;

/// Sixteen f32 in two registers. Only code that [`crate::accel::Path::Avx2`] leads to may touch one:
/// each `unsafe` below is the use of an instruction that such a processor has.
#[derive(Clone, Copy)]
pub struct Avx2(__m256, __m256);

/// Defines functions of two vectors, each one instruction for either half.
macro_rules! instructions {
    ($($name:ident = $instruction:ident;)*) => {$(
        #[inline(always)]
        fn $name(self, other: Self) -> Self {
            // SAFETY: the processor has AVX2, by the promise of the type.
            unsafe { Self($instruction(self.0, other.0), $instruction(self.1, other.1)) }
        }
    )*};
}

/// Defines comparisons.
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

    type Places = Places256;

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
    unsafe fn load_from(x: *const f32) -> Self {
        // SAFETY: as above; the caller promises the numbers.
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
        unsafe { _mm256_cvtss_f32(self.spread(lane).0) }
    }
    #[inline(always)]
    fn at(self, places: Places256) -> Self {
        Self(at(self, places.0), at(self, places.1))
    }
}

impl Lanes for Avx2 {
    type Narrow = Eight;

    const BEAMS: bool = true;

    comparisons! {
        lt = _CMP_LT_OQ;
    }
    #[inline(always)]
    fn load(x: &[f32; LANES]) -> Self {
        // SAFETY: the array has all lanes.
        unsafe { Self::load_from(x.as_ptr()) }
    }
    #[inline(always)]
    fn transposed(rays: &[Ray; LANES]) -> [Self; 8] {
        const { assert!(size_of::<Ray>() == 8 * size_of::<f32>()) };
        let (low, high) = (columns(&rays[..8]), columns(&rays[8..]));
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
    fn or(self, mask: Mask, other: Self) -> Self {
        // SAFETY: as above.
        unsafe {
            Self(
                _mm256_blendv_ps(self.0, other.0, lanes_of(mask)),
                _mm256_blendv_ps(self.1, other.1, lanes_of(mask >> 8)),
            )
        }
    }
    #[inline(always)]
    fn least(self) -> f32 {
        // SAFETY: as above.
        unsafe {
            let eight = _mm256_min_ps(self.0, self.1);
            let four = _mm_min_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps::<1>(eight));
            let two = _mm_min_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_min_ss(two, _mm_movehdup_ps(two)))
        }
    }
    #[inline(always)]
    fn greatest(self) -> f32 {
        // SAFETY: as above.
        unsafe {
            let eight = _mm256_max_ps(self.0, self.1);
            let four = _mm_max_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps::<1>(eight));
            let two = _mm_max_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_max_ss(two, _mm_movehdup_ps(two)))
        }
    }
    #[inline(always)]
    fn spread(self, lane: u32) -> Self {
        let half = if lane < 8 { self.0 } else { self.1 };
        // SAFETY: as above.
        unsafe {
            let all = _mm256_permutevar8x32_ps(half, _mm256_set1_epi32(lane as i32));
            Self(all, all)
        }
    }
    #[inline(always)]
    fn spread_narrow(self, lane: u32) -> Eight {
        Eight(self.spread(lane).0)
    }
    #[inline(always)]
    fn turned(self, _flip: u32) -> Self {
        self
    }
    #[inline(always)]
    fn turned_mask(mask: Mask, flip: u32) -> Mask {
        flipped(mask, flip)
    }
    #[inline(always)]
    fn push(
        self,
        stack: &mut Stack,
        len: usize,
        mask: Mask,
        children: &[u32; LANES],
        flip: u32,
    ) -> usize {
        // SAFETY: as above; the array has all lanes.
        let children = unsafe {
            let children = children.as_ptr();
            [_mm256_loadu_si256(children.cast()), _mm256_loadu_si256(children.add(8).cast())]
        };
        push(stack, len, mask, flip, children, [self.0, self.1])
    }
    #[inline(always)]
    fn push_slots(self, stack: &mut Stack, len: usize, mask: Mask, first: u32, flip: u32) -> usize {
        // SAFETY: as above.
        let slots = unsafe {
            let low = _mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0);
            let from = |first: u32| _mm256_add_epi32(low, _mm256_set1_epi32(first as i32));
            [from(first), from(first + 8)]
        };
        push(stack, len, mask, flip, slots, [self.0, self.1])
    }
}

/// All bits of the lanes of the lower half of a mask.
#[inline(always)]
fn lanes_of(mask: Mask) -> __m256 {
    // SAFETY: takes or makes such vectors, for which the processor has the instructions.
    unsafe {
        let bits = _mm256_set_epi32(128, 64, 32, 16, 8, 4, 2, 1);
        let chosen = _mm256_and_si256(_mm256_set1_epi32(i32::from(mask)), bits);
        _mm256_castsi256_ps(_mm256_cmpeq_epi32(chosen, bits))
    }
}

/// [`Places`] in the lowest four bits of each lane, with anything above.
#[derive(Clone, Copy)]
pub struct Places256(__m256i, __m256i);

impl Places for Places256 {
    #[inline(always)]
    fn new([even, odd]: [u32; 2]) -> Self {
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

/// Eight lanes of sixteen, by the lowest four bits of `places`.
#[inline(always)]
fn at(from: Avx2, places: __m256i) -> __m256 {
    // SAFETY: takes or makes such vectors, for which the processor has the instructions.
    unsafe {
        let low = _mm256_permutevar8x32_ps(from.0, places);
        let high = _mm256_permutevar8x32_ps(from.1, places);
        // The fourth bit, as the sign, chooses.
        _mm256_blendv_ps(low, high, _mm256_castsi256_ps(_mm256_slli_epi32::<28>(places)))
    }
}
