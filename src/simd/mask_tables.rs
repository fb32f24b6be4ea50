//! Tables by mask for AVX2, in place of the instructions of AVX-512 that permute masks and compress lanes.

use std::arch::x86_64::*;

use super::lanes::{LANES, Mask};

/// `FLIPS[flip][mask]` has bit `i` of the mask as bit `i ^ flip`.
static FLIPS: [[u8; 256]; 8] = {
    let mut flips = [[0; 256]; 8];
    let mut i = 0;
    while i < 8 * 256 * 8 {
        let (flip, mask, bit) = (i / 8 / 256, i / 8 % 256, i % 8);
        flips[flip][mask] |= ((mask >> bit & 1) << (bit ^ flip)) as u8;
        i += 1;
    }
    flips
};

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

/// The mask with bit `i` as bit `i ^ flip`.
#[inline(always)]
pub fn flipped(mask: Mask, flip: u32) -> Mask {
    if mask == 0 {
        return 0;
    }
    let flips = &FLIPS[flip as usize % 8];
    let mask = mask.to_le_bytes().map(|bits| flips[usize::from(bits)]);
    Mask::from_le_bytes(mask).rotate_left(flip & 8)
}

/// Writes `lane ^ flip` of `from_ids` and `from_distances` for each lane of `mask`, lowest first; see
/// `Lanes::compress_children`. To be called by `Avx2` alone, since it takes a processor with AVX2.
#[inline(always)]
pub fn compress(
    mask: Mask,
    flip: u32,
    from_ids: [__m256i; 2],
    from_distances: [__m256; 2],
    ids: &mut [u32; LANES],
    distances: &mut [f32; LANES],
) {
    // Bit 3 of `flip` swaps the halves.
    let is_swapped = flip & 8 != 0;
    let from_ids = if is_swapped { [from_ids[1], from_ids[0]] } else { from_ids };
    let from_distances =
        if is_swapped { [from_distances[1], from_distances[0]] } else { from_distances };
    let [low, high] = mask.to_le_bytes();
    // SAFETY: the processor has AVX2, since `Avx2` calls this. Each array has sixteen entries; `put` writes eight, at 0
    // and at the number of lanes of half a mask, which is at most eight.
    unsafe {
        let flip = _mm256_set1_epi32(flip as i32 & 7);
        let mut put = |half: usize, mask: u8, to: usize| {
            let lanes = _mm_loadl_epi64(LANES_OF[usize::from(mask)].as_ptr().cast());
            let lanes = _mm256_xor_si256(_mm256_cvtepu8_epi32(lanes), flip);
            let half_ids = _mm256_permutevar8x32_epi32(from_ids[half], lanes);
            _mm256_storeu_si256(ids.as_mut_ptr().add(to).cast(), half_ids);
            let half_distances = _mm256_permutevar8x32_ps(from_distances[half], lanes);
            _mm256_storeu_ps(distances.as_mut_ptr().add(to), half_distances);
        };
        put(0, low, 0);
        put(1, high, low.count_ones() as usize);
    }
}
