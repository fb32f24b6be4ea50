//! [`transpose8`]: from eight rays to vectors of their coordinates.

use std::arch::x86_64::*;

use crate::geometry::Ray;

/// o.x, o.y, o.z, t_min, d.x, d.y, d.z and t_max of eight rays. To be called by `Avx2` alone, since it takes a processor
/// with AVX2.
///
/// # Panics
/// If there are not eight.
#[inline(always)]
pub fn transpose8(rays: &[Ray]) -> [__m256; 8] {
    assert_eq!(rays.len(), 8);
    let numbers: *const f32 = rays.as_ptr().cast();
    // SAFETY: the processor has AVX2, since `Avx2` calls this; a ray is eight f32 in order (`repr(C)`), and there are eight.
    unsafe {
        // Four numbers of a ray, and in the upper half those of the fourth ray after it.
        let pair = |i: usize| {
            let low = _mm256_castps128_ps256(_mm_loadu_ps(numbers.add(i)));
            _mm256_insertf128_ps::<1>(low, _mm_loadu_ps(numbers.add(i + 32)))
        };
        let [ox, oy, oz, t_min] = transpose4(pair(0), pair(8), pair(16), pair(24));
        let [dx, dy, dz, t_max] = transpose4(pair(4), pair(12), pair(20), pair(28));
        [ox, oy, oz, t_min, dx, dy, dz, t_max]
    }
}

/// Transposes the 4 x 4 matrix in each half of four vectors.
#[inline(always)]
fn transpose4(a: __m256, b: __m256, c: __m256, d: __m256) -> [__m256; 4] {
    // SAFETY: as above.
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
