//! [`Avx2`]: [`Lanes`] with AVX2 instructions.

use std::arch::x86_64::*;

use super::f32x8::{F32x8, Indices8};
use super::float::Float;
use super::lanes::{Kernel, Lanes, Pick, Vector};
use super::twice::Twice;

/// Sixteen f32 in two registers. Only [`super::InstructionSet::run`] names this type, if [`Avx2::is_available`]: each
/// `unsafe` below executes an instruction that such a processor has.
pub type Avx2 = Twice<F32x8>;

impl Avx2 {
    /// Whether the processor has all that [`Avx2::call`] is compiled for.
    pub fn is_available() -> bool {
        is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("fma")
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
}

impl Pick<Self> for Avx2 {
    #[inline(always)]
    fn pick(self, Twice(low, high): Twice<Indices8>) -> Self {
        Self(self.pick(low), self.pick(high))
    }
}

impl Pick<F32x8> for Avx2 {
    #[inline(always)]
    fn pick(self, Indices8(indices): Indices8) -> F32x8 {
        // SAFETY: as above.
        unsafe {
            let low = _mm256_permutevar8x32_ps(self.0.0, indices);
            let high = _mm256_permutevar8x32_ps(self.1.0, indices);
            // The fourth bit, moved to the sign, picks the half.
            let half = _mm256_castsi256_ps(_mm256_slli_epi32::<28>(indices));
            F32x8(_mm256_blendv_ps(low, high, half))
        }
    }
}

impl Lanes for Avx2 {
    type Narrow = F32x8;

    type Block = F32x8;

    type Boxes = F32x8;

    #[inline(always)]
    fn call<K: Kernel>(
        data: &K::Data,
        scratch: &mut K::Scratch,
        input: &K::Input,
        kernel: K,
    ) -> K::Output {
        #[inline(never)]
        #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
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
}
