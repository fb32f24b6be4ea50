//! [`transpose8`] and [`transpose4`]: from records in memory to vectors of their numbers, and back.

use std::arch::x86_64::*;

/// Number i of each of eight records of eight numbers, for each i. To be called by the AVX2 vectors alone.
///
/// # Safety
/// The processor has AVX2, and eight numbers must be readable from each pointer on.
#[inline(always)]
pub unsafe fn transpose8(records: [*const f32; 8]) -> [__m256; 8] {
    let [r0, r1, r2, r3, r4, r5, r6, r7] = records;
    // SAFETY: the caller promises both.
    unsafe {
        let [a, b, c, d] = transpose4(pair(r0, r4), pair(r1, r5), pair(r2, r6), pair(r3, r7));
        let [e, f, g, h] = transpose4(
            pair(r0.add(4), r4.add(4)),
            pair(r1.add(4), r5.add(4)),
            pair(r2.add(4), r6.add(4)),
            pair(r3.add(4), r7.add(4)),
        );
        [a, b, c, d, e, f, g, h]
    }
}

/// Four numbers in the lower half, and four others in the upper half. To be called by the AVX2 vectors alone.
///
/// # Safety
/// The processor has AVX2, and four numbers must be readable from each pointer on.
#[inline(always)]
pub unsafe fn pair(low: *const f32, high: *const f32) -> __m256 {
    // SAFETY: the caller promises both.
    unsafe {
        let low = _mm256_castps128_ps256(_mm_loadu_ps(low));
        _mm256_insertf128_ps::<1>(low, _mm_loadu_ps(high))
    }
}

/// Transposes the 4 x 4 matrix in each half of four vectors. To be called by the AVX2 vectors alone.
///
/// # Safety
/// The processor has AVX2.
#[inline(always)]
pub unsafe fn transpose4(a: __m256, b: __m256, c: __m256, d: __m256) -> [__m256; 4] {
    // SAFETY: the caller promises it.
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
