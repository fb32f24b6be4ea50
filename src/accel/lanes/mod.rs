//! Sixteen numbers at a time, by the widest instructions that the processor has.
//!
//! All walks are written once, over [`Lanes`]. Each operation is the IEEE 754 operation of each lane, and
//! none is fused, so that every implementation gives the same bits as f32 does.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
#[cfg(target_arch = "x86_64")]
mod columns;
#[cfg(target_arch = "x86_64")]
mod eight;
#[cfg(target_arch = "x86_64")]
mod halves;
mod portable;

#[cfg(target_arch = "x86_64")]
pub use avx2::Avx2;
#[cfg(target_arch = "x86_64")]
pub use avx512::Avx512;
pub use portable::Portable;

use super::stack::Stack;
use crate::geometry::Ray;

/// How many lanes there are: children of a node, triangles of a leaf, rays of a packet.
pub const LANES: usize = 16;

/// One bit for each lane.
pub type Mask = u16;

/// For each lane the number of a lane, in four bits: those of even lanes in the first of two words, lowest
/// first, and those of odd lanes in the second.
pub trait Places: Copy {
    fn new(words: [u32; 2]) -> Self;
}

/// Several f32, up to sixteen: what the test of a ray against triangles takes. Only [`super::path`] chooses between
/// the types that have this trait, and asks the processor first: all others use instructions that it may not have.
pub trait Vector: Copy {
    /// How many there are.
    const LANES: usize;

    type Places: Places;

    fn splat(x: f32) -> Self;
    /// Numbers from `x` on.
    ///
    /// # Safety
    /// They have to be there, [`LANES`] of them.
    unsafe fn load_from(x: *const f32) -> Self;
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    /// The smaller; `other` where one is NaN.
    fn min(self, other: Self) -> Self;
    /// The larger; `other` where one is NaN.
    fn max(self, other: Self) -> Self;
    fn abs(self) -> Self;
    /// Whether `self <= other`; not where one is NaN.
    fn le(self, other: Self) -> Mask;
    /// Whether both are equal; not where one is NaN.
    fn eq(self, other: Self) -> Mask;
    /// The number in a lane.
    fn lane(self, lane: u32) -> f32;
    /// Lane `i` becomes the lane that it has the number of.
    fn at(self, places: Self::Places) -> Self;
}

/// Sixteen f32.
pub trait Lanes: Vector {
    /// What leaves are tested with that hold no more vertices and triangles than it has lanes.
    type Narrow: Vector;

    /// Whether vectors are wide enough for packets of rays to pay.
    const BEAMS: bool;

    fn load(x: &[f32; LANES]) -> Self;
    /// Origin, t_min, direction and t_max of each ray.
    fn transposed(rays: &[Ray; LANES]) -> [Self; 8];
    fn to_array(self) -> [f32; LANES];
    /// Whether `self < other`; not where one is NaN.
    fn lt(self, other: Self) -> Mask;
    /// `other` in the lanes of `mask`.
    fn or(self, mask: Mask, other: Self) -> Self;
    /// The least of all; undefined if one is NaN.
    fn least(self) -> f32;
    /// The largest of all; undefined if one is NaN.
    fn greatest(self) -> f32;
    /// The least and the largest lane of each of four vectors; undefined if one is NaN.
    #[inline(always)]
    fn extremes([a, b, c, d]: [Self; 4]) -> [[f32; 4]; 2] {
        [
            [a.least(), b.least(), c.least(), d.least()],
            [a.greatest(), b.greatest(), c.greatest(), d.greatest()],
        ]
    }
    /// The number in a lane in all lanes.
    fn spread(self, lane: u32) -> Self;
    /// The same of fewer lanes.
    fn spread_narrow(self, lane: u32) -> Self::Narrow;
    /// Lane `i` becomes lane `i ^ flip`; but all stay where it is quicker to flip the masks of what is computed
    /// from them.
    fn turned(self, flip: u32) -> Self;
    /// A mask of vectors that were [turned](Lanes::turned), with its lanes flipped.
    #[inline(always)]
    fn turned_mask(mask: Mask, _flip: u32) -> Mask {
        mask
    }
    /// Puts the children in the lanes of `mask`, whose lanes are flipped, on the stack, where `len` wait already,
    /// the lowest lane lowest. `self` says where the ray enters them, and is [turned](Lanes::turned). How many
    /// wait then.
    #[inline(always)]
    fn push(
        self,
        stack: &mut Stack,
        len: usize,
        mask: Mask,
        children: &[u32; LANES],
        flip: u32,
    ) -> usize {
        push_each(stack, len, mask, self.to_array(), |lane| {
            children[(lane ^ flip) as usize % LANES]
        })
    }
    /// Puts the slots of a node on the stack as [`Lanes::push`] does children: slot i as `first` + i.
    #[inline(always)]
    fn push_slots(self, stack: &mut Stack, len: usize, mask: Mask, first: u32, flip: u32) -> usize {
        push_each(stack, len, mask, self.to_array(), |lane| first + (lane ^ flip))
    }
}

/// Puts what stands for the lanes of `mask` on the stack.
#[inline(always)]
fn push_each(
    stack: &mut Stack,
    mut len: usize,
    mut mask: Mask,
    enters: [f32; LANES],
    child: impl Fn(u32) -> u32,
) -> usize {
    while mask != 0 {
        let lane = mask.trailing_zeros();
        stack.set(len, child(lane), enters[lane as usize % LANES]);
        len += 1;
        mask &= mask - 1;
    }
    len
}

/// Each of three numbers in all lanes. Written out, because `map` is not always inlined.
#[inline(always)]
pub fn splat3<L: Vector>([x, y, z]: [f32; 3]) -> [L; 3] {
    [L::splat(x), L::splat(y), L::splat(z)]
}
