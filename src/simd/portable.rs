//! [`Portable`]: [`Lanes`] of glam's vectors, which every target has.

use std::array::from_fn;

use glam::Vec4;

use super::float::{Block, Float};
use super::lanes::{Kernel, LANES, LaneIndices, Lanes, Pick, Vector};
use super::twice::Twice;

/// Sixteen f32.
pub type Portable = Twice<Twice<Vec4>>;

impl Vector for Portable {
    type Indices = [u8; LANES];

    #[inline(always)]
    fn lane(self, lane: u32) -> f32 {
        self.to_array()[lane as usize % LANES]
    }
}

impl Pick<Self> for Portable {
    #[inline(always)]
    fn pick(self, indices: [u8; LANES]) -> Self {
        let from = self.to_array();
        Self::load(&indices.map(|i| from[usize::from(i) % LANES]))
    }
}

impl Lanes for Portable {
    type Narrow = Self;

    type Block = Vec4;

    type Boxes = Twice<Vec4>;

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
    fn reduce_min(self) -> f32 {
        let Twice(low, high) = self.0.min(self.1);
        Float::min(low, high).min_element()
    }
}

impl LaneIndices for [u8; LANES] {
    #[inline(always)]
    fn unpack(words: [u32; 2]) -> Self {
        from_fn(|i| (words[i % 2] >> (4 * (i / 2)) & 15) as u8)
    }
}
