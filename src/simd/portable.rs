//! [`Portable`]: [`Lanes`] in plain Rust, which the compiler turns into vectors of the target.

use std::array::from_fn;

use glam::Vec4;

use super::lanes::{Kernel, LANES, LaneIndices, Lanes, Mask, Vector};

/// Sixteen f32 in an array.
#[derive(Clone, Copy)]
pub struct Portable([f32; LANES]);

impl Portable {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        Self(from_fn(|i| f(self.0[i], other.0[i])))
    }

    #[inline(always)]
    fn mask(self, other: Self, f: impl Fn(f32, f32) -> bool) -> Mask {
        (0..LANES).fold(0, |mask, i| mask | Mask::from(f(self.0[i], other.0[i])) << i)
    }
}

impl Vector for Portable {
    const LANES: usize = LANES;

    type Indices = [u8; LANES];

    #[inline(always)]
    fn splat(x: f32) -> Self {
        Self([x; LANES])
    }
    #[inline(always)]
    unsafe fn load_unaligned(x: *const f32) -> Self {
        // SAFETY: the caller promises that the numbers are readable.
        Self(unsafe { x.cast::<[f32; LANES]>().read_unaligned() })
    }
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(f32::abs))
    }
    #[inline(always)]
    fn le(self, other: Self) -> Mask {
        self.mask(other, |a, b| a <= b)
    }
    #[inline(always)]
    fn eq(self, other: Self) -> Mask {
        self.mask(other, |a, b| a == b)
    }
    #[inline(always)]
    fn lane(self, lane: u32) -> f32 {
        self.0[lane as usize % LANES]
    }
    #[inline(always)]
    fn permute(self, indices: [u8; LANES]) -> Self {
        Self(from_fn(|i| self.0[usize::from(indices[i]) % LANES]))
    }
}

impl Lanes for Portable {
    type Narrow = Self;

    type Block = Vec4;

    const USES_PACKETS: bool = false;

    const SKIPS_EMPTY: bool = true;

    #[inline(always)]
    fn call<K: Kernel>(
        data: &K::Data,
        scratch: &mut K::Scratch,
        input: &K::Input,
        kernel: K,
    ) -> K::Output {
        #[inline(never)]
        fn out_of_line<K: Kernel>(
            data: &K::Data,
            scratch: &mut K::Scratch,
            input: &K::Input,
            kernel: K,
        ) -> K::Output {
            kernel.run::<Portable>(input, data, scratch)
        }
        out_of_line(data, scratch, input, kernel)
    }

    #[inline(always)]
    fn load(x: &[f32; LANES]) -> Self {
        Self(*x)
    }
    #[inline(always)]
    fn transpose(records: &[[f32; 8]; LANES]) -> [Self; 8] {
        from_fn(|number| Self(from_fn(|i| records[i][number])))
    }
    #[inline(always)]
    fn reduce_min(self) -> f32 {
        self.0.into_iter().fold(f32::INFINITY, f32::min)
    }
    #[inline(always)]
    fn reduce_max(self) -> f32 {
        self.0.into_iter().fold(f32::NEG_INFINITY, f32::max)
    }
    #[inline(always)]
    fn to_array(self) -> [f32; LANES] {
        self.0
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Mask {
        self.mask(other, |a, b| a < b)
    }
    #[inline(always)]
    fn blend(self, mask: Mask, other: Self) -> Self {
        Self(from_fn(|i| if mask >> i & 1 == 1 { other.0[i] } else { self.0[i] }))
    }
    #[inline(always)]
    fn broadcast(self, lane: u32) -> Self {
        Self::splat(self.lane(lane))
    }
    #[inline(always)]
    fn broadcast_narrow(self, lane: u32) -> Self {
        self.broadcast(lane)
    }
    #[inline(always)]
    fn flip(self, flip: u32) -> Self {
        Self(from_fn(|i| self.0[(i ^ flip as usize) % LANES]))
    }
}

impl LaneIndices for [u8; LANES] {
    #[inline(always)]
    fn unpack(words: [u32; 2]) -> Self {
        from_fn(|i| (words[i % 2] >> (4 * (i / 2)) & 15) as u8)
    }
}
