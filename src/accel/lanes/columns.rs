//! Rays as columns of numbers, eight at a time.

use std::arch::x86_64::*;

use crate::geometry::Ray;

/// Origin, t_min, direction and t_max of eight rays.
#[inline(always)]
pub fn columns(rays: &[Ray]) -> [__m256; 8] {
    assert_eq!(rays.len(), 8);
    let numbers: *const f32 = rays.as_ptr().cast();
    // SAFETY: called from above; a ray is eight f32 in order (`repr(C)`), and there are eight.
    unsafe {
        // Origin and t_min of a ray beside those of the fourth after it; and likewise of what follows.
        let beside = |i: usize| {
            let low = _mm256_castps128_ps256(_mm_loadu_ps(numbers.add(i)));
            _mm256_insertf128_ps::<1>(low, _mm_loadu_ps(numbers.add(i + 32)))
        };
        let [ox, oy, oz, t_min] = four(beside(0), beside(8), beside(16), beside(24));
        let [dx, dy, dz, t_max] = four(beside(4), beside(12), beside(20), beside(28));
        [ox, oy, oz, t_min, dx, dy, dz, t_max]
    }
}

/// The columns of the four-by-four matrices in each half of four rows.
#[inline(always)]
fn four(a: __m256, b: __m256, c: __m256, d: __m256) -> [__m256; 4] {
    // SAFETY: takes or makes such vectors, for which the processor has the instructions.
    unsafe {
        let (ab, cd) = (_mm256_unpacklo_ps(a, b), _mm256_unpacklo_ps(c, d));
        let (ab2, cd2) = (_mm256_unpackhi_ps(a, b), _mm256_unpackhi_ps(c, d));
        [
            _mm256_shuffle_ps::<0x44>(ab, cd),
            _mm256_shuffle_ps::<0xee>(ab, cd),
            _mm256_shuffle_ps::<0x44>(ab2, cd2),
            _mm256_shuffle_ps::<0xee>(ab2, cd2),
        ]
    }
}
