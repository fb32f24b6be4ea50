//! Masks of sixteen lanes, of which vectors have eight: what AVX-512 has instructions for is looked up in tables.

use std::arch::x86_64::*;

use super::Mask;
use crate::accel::stack::Stack;

/// For each flip below eight and each mask: bit i of the mask as bit `i ^ flip`.
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

/// For each mask which lanes it has, the lowest first, and 0 behind them.
static CHOSEN: [[u8; 8]; 256] = {
    let mut chosen = [[0; 8]; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut bit, mut len) = (0, 0);
        while bit < 8 {
            if mask >> bit & 1 == 1 {
                chosen[mask][len] = bit as u8;
                len += 1;
            }
            bit += 1;
        }
        mask += 1;
    }
    chosen
};

/// The mask with its lanes flipped.
#[inline(always)]
pub fn flipped(mask: Mask, flip: u32) -> Mask {
    if mask == 0 {
        return 0;
    }
    let flips = &FLIPS[flip as usize % 8];
    let mask = mask.to_le_bytes().map(|bits| flips[usize::from(bits)]);
    Mask::from_le_bytes(mask).rotate_left(flip & 8)
}

/// [`super::Lanes::push`] of what stands for the children, where neither that nor `enters` is flipped.
/// To be called by [`super::Avx2`] alone.
#[inline(always)]
pub fn push(
    stack: &mut Stack,
    len: usize,
    mask: Mask,
    flip: u32,
    words: [__m256i; 2],
    enters: [__m256; 2],
) -> usize {
    if mask == 0 {
        return len;
    }
    // In halves, those first that come first when flipped.
    let words = if flip & 8 == 0 { words } else { [words[1], words[0]] };
    let enters = if flip & 8 == 0 { enters } else { [enters[1], enters[0]] };
    let (waiting, waiting_enters) = stack.room(len);
    let [low, high] = mask.to_le_bytes();
    // SAFETY: the processor has AVX2, as it has the vectors. The arrays have all lanes, and at most eight go before
    // the upper half. Lanes after those of the mask are overwritten by the next push, and never read.
    unsafe {
        let flip = _mm256_set1_epi32(flip as i32 & 7);
        let mut put = |half: usize, mask: u8, to: usize| {
            let chosen = _mm_loadl_epi64(CHOSEN[usize::from(mask)].as_ptr().cast());
            let lanes = _mm256_xor_si256(_mm256_cvtepu8_epi32(chosen), flip);
            let words = _mm256_permutevar8x32_epi32(words[half], lanes);
            _mm256_storeu_si256(waiting.as_mut_ptr().add(to).cast(), words);
            let enters = _mm256_permutevar8x32_ps(enters[half], lanes);
            _mm256_storeu_ps(waiting_enters.as_mut_ptr().add(to), enters);
        };
        put(0, low, 0);
        put(1, high, low.count_ones() as usize);
    }
    len + mask.count_ones() as usize
}
