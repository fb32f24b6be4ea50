//! [`Avx512`]: [`Lanes`] with AVX-512 instructions.

use std::arch::x86_64::*;

use super::avx2::Avx2;
use super::lanes::{Kernel, LANES, LaneIndices, Lanes, Mask, Vector};
use crate::geometry::Ray;

/// Sixteen f32 in one register. Only [`super::InstructionSet::run`] names this type, if [`Avx512::is_available`]: each
/// `unsafe` below executes an instruction that such a processor has.
#[derive(Clone, Copy)]
pub struct Avx512(__m512);

impl Avx512 {
    /// Whether the processor has all that [`Avx512::call`] is compiled for.
    pub fn is_available() -> bool {
        Avx2::is_available()
            && is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512dq")
    }
}

/// Defines methods that take one or two vectors and are one instruction.
macro_rules! instructions {
    ($($name:ident($($argument:ident),*) -> $result:ty = $instruction:expr;)*) => {$(
        #[inline(always)]
        fn $name(self, $($argument: Self),*) -> $result {
            // SAFETY: the processor has AVX-512, by the promise of the type.
            unsafe { $instruction(self.0, $($argument.0),*) }.into()
        }
    )*};
}

impl From<__m512> for Avx512 {
    #[inline(always)]
    fn from(x: __m512) -> Self {
        Self(x)
    }
}

impl Vector for Avx512 {
    const LANES: usize = LANES;

    type Indices = Indices512;

    instructions! {
        add(other) -> Self = _mm512_add_ps;
        sub(other) -> Self = _mm512_sub_ps;
        mul(other) -> Self = _mm512_mul_ps;
        div(other) -> Self = _mm512_div_ps;
        min(other) -> Self = _mm512_min_ps;
        max(other) -> Self = _mm512_max_ps;
        abs() -> Self = _mm512_abs_ps;
        le(other) -> Mask = _mm512_cmp_ps_mask::<_CMP_LE_OQ>;
        eq(other) -> Mask = _mm512_cmp_ps_mask::<_CMP_EQ_OQ>;
    }
    #[inline(always)]
    fn splat(x: f32) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_set1_ps(x) })
    }
    #[inline(always)]
    unsafe fn load_unaligned(x: *const f32) -> Self {
        // SAFETY: as above; the caller promises that the numbers are readable.
        Self(unsafe { _mm512_loadu_ps(x) })
    }
    #[inline(always)]
    fn lane(self, lane: u32) -> f32 {
        // SAFETY: as above.
        unsafe { _mm512_cvtss_f32(_mm512_maskz_compress_ps(1 << lane, self.0)) }
    }
    #[inline(always)]
    fn permute(self, indices: Indices512) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_permutexvar_ps(indices.0, self.0) })
    }
}

impl Lanes for Avx512 {
    type Narrow = Self;

    const USES_PACKETS: bool = true;

    const SKIPS_EMPTY: bool = false;

    #[inline(always)]
    fn call<K: Kernel>(
        data: &K::Data,
        scratch: &mut K::Scratch,
        input: &K::Input,
        kernel: K,
    ) -> K::Output {
        #[inline(never)]
        #[target_feature(enable = "avx512f,avx512vl,avx512bw,avx512dq,avx2,bmi1,bmi2,lzcnt,popcnt")]
        fn with_features<K: Kernel>(
            data: &K::Data,
            scratch: &mut K::Scratch,
            input: &K::Input,
            kernel: K,
        ) -> K::Output {
            kernel.run::<Avx512>(input, data, scratch)
        }
        // SAFETY: the processor has AVX-512, by the promise of the type.
        unsafe { with_features(data, scratch, input, kernel) }
    }

    instructions! {
        lt(other) -> Mask = _mm512_cmp_ps_mask::<_CMP_LT_OQ>;
    }
    #[inline(always)]
    fn load(x: &[f32; LANES]) -> Self {
        // SAFETY: as above; the array has all lanes.
        Self(unsafe { _mm512_loadu_ps(x.as_ptr()) })
    }
    #[inline(always)]
    fn transpose_rays(rays: &[Ray; LANES]) -> [Self; 8] {
        const { assert!(size_of::<Ray>() == 8 * size_of::<f32>()) };
        // SAFETY: as above; a ray is eight f32 in order (`repr(C)`), and there are sixteen.
        unsafe {
            // Rays 0 to 3 beside 4 to 7, and 8 to 11 beside 12 to 15.
            let (a, b) = (rays.as_ptr(), rays.as_ptr().add(8));
            let a = transpose4(pair(a), pair(a.add(1)), pair(a.add(2)), pair(a.add(3)));
            let b = transpose4(pair(b), pair(b.add(1)), pair(b.add(2)), pair(b.add(3)));
            let ([ox, dx], [oy, dy]) = (deinterleave(a[0], b[0]), deinterleave(a[1], b[1]));
            let ([oz, dz], [t_min, t_max]) = (deinterleave(a[2], b[2]), deinterleave(a[3], b[3]));
            [ox, oy, oz, t_min, dx, dy, dz, t_max]
        }
    }
    #[inline(always)]
    fn reduce_min(self) -> f32 {
        // SAFETY: as above.
        unsafe { _mm512_reduce_min_ps(self.0) }
    }
    #[inline(always)]
    fn reduce_max(self) -> f32 {
        // SAFETY: as above.
        unsafe { _mm512_reduce_max_ps(self.0) }
    }
    #[inline(always)]
    fn reduce_min_max([a, b, c, d]: [Self; 4]) -> [[f32; 4]; 2] {
        let mut extremes = [0.0; LANES];
        // SAFETY: as above; the array has room for all lanes.
        unsafe {
            let least = reduce4(a.0, b.0, c.0, d.0, |a, b| _mm512_min_ps(a, b));
            let most = reduce4(a.0, b.0, c.0, d.0, |a, b| _mm512_max_ps(a, b));
            // Each quarter, for one of the vectors: two candidates for the smallest, two for the largest.
            let (low, high) =
                (_mm512_shuffle_ps::<0x44>(least, most), _mm512_shuffle_ps::<0xee>(least, most));
            let both = _mm512_mask_max_ps(_mm512_min_ps(low, high), 0xcccc, low, high);
            let other = _mm512_permute_ps::<0b10_11_00_01>(both);
            let both = _mm512_mask_max_ps(_mm512_min_ps(both, other), 0xcccc, both, other);
            _mm512_storeu_ps(extremes.as_mut_ptr(), both);
        }
        let of = |first: usize| {
            [extremes[first], extremes[first + 4], extremes[first + 8], extremes[first + 12]]
        };
        [of(0), of(2)]
    }
    #[inline(always)]
    fn to_array(self) -> [f32; LANES] {
        let mut x = [0.0; LANES];
        // SAFETY: as above; the array has room for all lanes.
        unsafe { _mm512_storeu_ps(x.as_mut_ptr(), self.0) };
        x
    }
    #[inline(always)]
    fn blend(self, mask: Mask, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_mask_mov_ps(self.0, mask, other.0) })
    }
    #[inline(always)]
    fn broadcast(self, lane: u32) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_permutexvar_ps(_mm512_set1_epi32(lane as i32), self.0) })
    }
    #[inline(always)]
    fn broadcast_narrow(self, lane: u32) -> Self {
        self.broadcast(lane)
    }
    #[inline(always)]
    fn flip(self, flip: u32) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_permutexvar_ps(flips(flip), self.0) })
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
        // SAFETY: as above; the arrays have all lanes.
        unsafe {
            let children = _mm512_loadu_si512(children.as_ptr().cast());
            let children = _mm512_permutexvar_epi32(flips(flip), children);
            let children = _mm512_maskz_compress_epi32(mask, children);
            _mm512_storeu_si512(ids.as_mut_ptr().cast(), children);
            _mm512_storeu_ps(distances.as_mut_ptr(), _mm512_maskz_compress_ps(mask, self.0));
        }
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
        // SAFETY: as above; the arrays have all lanes.
        unsafe {
            let slots = _mm512_add_epi32(flips(flip), _mm512_set1_epi32(first as i32));
            let slots = _mm512_maskz_compress_epi32(mask, slots);
            _mm512_storeu_si512(ids.as_mut_ptr().cast(), slots);
            _mm512_storeu_ps(distances.as_mut_ptr(), _mm512_maskz_compress_ps(mask, self.0));
        }
    }
}

/// `i ^ flip` in each lane i.
#[inline(always)]
fn flips(flip: u32) -> __m512i {
    // SAFETY: as above.
    unsafe {
        let lanes = _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
        _mm512_xor_si512(lanes, _mm512_set1_epi32(flip as i32))
    }
}

/// Transposes the 4 x 4 matrix in each quarter of four vectors.
#[inline(always)]
fn transpose4(a: __m512, b: __m512, c: __m512, d: __m512) -> [__m512; 4] {
    // SAFETY: as above.
    unsafe {
        let (ab, cd) = (_mm512_unpacklo_ps(a, b), _mm512_unpacklo_ps(c, d));
        let (ab2, cd2) = (_mm512_unpackhi_ps(a, b), _mm512_unpackhi_ps(c, d));
        [
            _mm512_shuffle_ps::<0x44>(ab, cd),
            _mm512_shuffle_ps::<0xee>(ab, cd),
            _mm512_shuffle_ps::<0x44>(ab2, cd2),
            _mm512_shuffle_ps::<0xee>(ab2, cd2),
        ]
    }
}

/// A ray in the lower half, and the fourth after it in the upper half.
///
/// # Safety
/// Five rays must be readable from `ray` on.
#[inline(always)]
unsafe fn pair(ray: *const Ray) -> __m512 {
    // SAFETY: as above; the caller promises that the rays are readable.
    unsafe {
        let other = _mm256_loadu_ps(ray.add(4).cast());
        _mm512_insertf32x8::<1>(_mm512_castps256_ps512(_mm256_loadu_ps(ray.cast())), other)
    }
}

/// The even quarters of both vectors, and the odd ones.
#[inline(always)]
fn deinterleave(a: __m512, b: __m512) -> [Avx512; 2] {
    // SAFETY: as above.
    unsafe {
        [Avx512(_mm512_shuffle_f32x4::<0x88>(a, b)), Avx512(_mm512_shuffle_f32x4::<0xdd>(a, b))]
    }
}

/// Reduces each vector to a quarter, whose lanes are `f` of the lanes of its four quarters, and puts those next to each
/// other.
#[inline(always)]
fn reduce4(
    a: __m512,
    b: __m512,
    c: __m512,
    d: __m512,
    f: impl Fn(__m512, __m512) -> __m512,
) -> __m512 {
    // SAFETY: as above.
    unsafe {
        // Two quarters of each vector: a, a, b, b and c, c, d, d.
        let ab = f(_mm512_shuffle_f32x4::<0x44>(a, b), _mm512_shuffle_f32x4::<0xee>(a, b));
        let cd = f(_mm512_shuffle_f32x4::<0x44>(c, d), _mm512_shuffle_f32x4::<0xee>(c, d));
        f(_mm512_shuffle_f32x4::<0x88>(ab, cd), _mm512_shuffle_f32x4::<0xdd>(ab, cd))
    }
}

/// [`LaneIndices`] in the lowest four bits of each lane, the bits above unspecified.
#[derive(Clone, Copy)]
pub struct Indices512(__m512i);

impl LaneIndices for Indices512 {
    #[inline(always)]
    fn unpack([even, odd]: [u32; 2]) -> Self {
        let words = u64::from(even) | u64::from(odd) << 32;
        // SAFETY: as above.
        unsafe {
            let shifts = _mm512_set_epi32(28, 28, 24, 24, 20, 20, 16, 16, 12, 12, 8, 8, 4, 4, 0, 0);
            Self(_mm512_srlv_epi32(_mm512_set1_epi64(words as i64), shifts))
        }
    }
}
