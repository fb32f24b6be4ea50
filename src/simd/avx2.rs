//! [`Avx2`]: [`Lanes`] with AVX2 instructions.

use std::arch::x86_64::*;

use super::f32x8::{F32x8, Indices8};
use super::float::Float;
use super::lanes::{Kernel, LANES, Lanes, Mask, Vector};
use super::twice::Twice;

/// Sixteen f32 in two registers. Only [`super::InstructionSet::run`] names this type, if [`Avx2::is_available`]: each
/// `unsafe` below executes an instruction that such a processor has.
pub type Avx2 = Twice<F32x8>;

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

impl Vector for Avx2 {
    type Indices = Twice<Indices8>;

    #[inline(always)]
    fn lane(self, lane: u32) -> f32 {
        if lane < 8 { self.0.lane(lane) } else { self.1.lane(lane) }
    }
    #[inline(always)]
    fn permute(self, Twice(low, high): Self::Indices) -> Self {
        Self(pick(self, low), pick(self, high))
    }
}

impl Lanes for Avx2 {
    type Narrow = F32x8;

    type Block = F32x8;

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

    #[inline(always)]
    fn reduce_min(self) -> f32 {
        let F32x8(eight) = self.0.min(self.1);
        // SAFETY: as above.
        unsafe {
            let four = _mm_min_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps::<1>(eight));
            let two = _mm_min_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_min_ss(two, _mm_movehdup_ps(two)))
        }
    }
    #[inline(always)]
    fn compress(from: [Self; 2], mask: Mask, flip: u32, to: [&mut [f32; LANES]; 2]) {
        let [low, high] = [mask as u8, (mask >> 8) as u8];
        // Bit 3 of `flip` swaps the halves.
        let is_swapped = flip & 8 != 0;
        let [Twice(a0, a1), Twice(b0, b1)] = from;
        let (a0, b0, a1, b1) = if is_swapped { (a1, b1, a0, b0) } else { (a0, b0, a1, b1) };
        // SAFETY: as above. There is room for eight numbers at 0 and behind the lanes of half a mask, at most eight.
        unsafe {
            let flip = _mm256_set1_epi32(flip as i32 & 7);
            let [to_a, to_b] = [to[0].as_mut_ptr(), to[1].as_mut_ptr()];
            let lanes = _mm256_xor_si256(lanes_of(low), flip);
            _mm256_storeu_ps(to_a, _mm256_permutevar8x32_ps(a0.0, lanes));
            _mm256_storeu_ps(to_b, _mm256_permutevar8x32_ps(b0.0, lanes));
            let (lanes, len) = (_mm256_xor_si256(lanes_of(high), flip), low.count_ones() as usize);
            _mm256_storeu_ps(to_a.add(len), _mm256_permutevar8x32_ps(a1.0, lanes));
            _mm256_storeu_ps(to_b.add(len), _mm256_permutevar8x32_ps(b1.0, lanes));
        }
    }
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

/// [`LANES_OF`] a mask as a vector.
#[inline(always)]
fn lanes_of(mask: u8) -> __m256i {
    // SAFETY: as above; each entry has eight bytes.
    unsafe { _mm256_cvtepu8_epi32(_mm_loadl_epi64(LANES_OF[usize::from(mask)].as_ptr().cast())) }
}

/// Picks eight lanes of sixteen by the lowest four bits of each index.
#[inline(always)]
fn pick(from: Avx2, Indices8(indices): Indices8) -> F32x8 {
    // SAFETY: as above.
    unsafe {
        let low = _mm256_permutevar8x32_ps(from.0.0, indices);
        let high = _mm256_permutevar8x32_ps(from.1.0, indices);
        // The fourth bit, moved to the sign, picks the half.
        F32x8(_mm256_blendv_ps(low, high, _mm256_castsi256_ps(_mm256_slli_epi32::<28>(indices))))
    }
}
