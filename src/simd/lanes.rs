//! [`Vector`] and [`Lanes`]: what traversal asks of vectors of f32. [`Kernel`]: code that is generic over them.
//!
//! Each operation is the IEEE 754 operation in each lane, and no multiply-add is fused. So every implementation
//! gives the same bits as scalar f32 code.

use super::float::Block;

/// Number of lanes of a [`Lanes`]: children per node, most triangles per leaf, rays per packet.
pub const LANES: usize = 16;

/// One bit per lane, lane 0 lowest.
pub type Mask = u16;

/// Code that is written once for all instruction sets.
///
/// Its arguments are `self`, what is asked, data that is read for it, and scratch memory. The latter three are references of
/// their own because the compiler knows of parameters, not of fields, that they do not alias: as fields they cost a ray
/// 4 % more instructions.
///
/// Implementations mark `run` `#[inline(always)]`: it is compiled for an instruction set only as part of the
/// function with `#[target_feature]` that calls it. Anything in it that takes or returns vectors has to be inlined
/// for the same reason.
pub trait Kernel {
    /// What is asked.
    type Input: ?Sized;
    /// What is read for it.
    type Data: ?Sized;
    /// What is written on the way, and is of no interest afterwards.
    type Scratch: ?Sized;
    /// The result.
    type Output;

    /// Runs the code with one type of vectors.
    fn run<L: Lanes>(
        self,
        input: &Self::Input,
        data: &Self::Data,
        scratch: &mut Self::Scratch,
    ) -> Self::Output;
}

/// For each lane the index of a lane; operand of [`Vector::permute`].
pub trait LaneIndices: Copy {
    /// Unpacks four bits per lane: even lanes from the first word, odd lanes from the second, lowest lane lowest.
    fn unpack(words: [u32; 2]) -> Self;
}

/// A vector of eight or sixteen f32: what the ray-triangle test needs.
pub trait Vector: Copy {
    /// Number of lanes.
    const LANES: usize;

    /// Operand of [`Vector::permute`].
    type Indices: LaneIndices;

    /// The same number in all lanes.
    fn splat(x: f32) -> Self;
    /// Loads consecutive numbers; `x` need not be aligned.
    ///
    /// # Safety
    /// `Self::LANES` numbers must be readable from `x` on.
    unsafe fn load_unaligned(x: *const f32) -> Self;
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    /// The smaller number; `other` where either is NaN.
    fn min(self, other: Self) -> Self;
    /// The larger number; `other` where either is NaN.
    fn max(self, other: Self) -> Self;
    fn abs(self) -> Self;
    /// Lanes where `self <= other`; false where either is NaN.
    fn le(self, other: Self) -> Mask;
    /// Lanes where both are equal; false where either is NaN.
    fn eq(self, other: Self) -> Mask;
    /// The number in one lane.
    fn lane(self, lane: u32) -> f32;
    /// Lane `i` of the result is lane `indices[i]` of `self`.
    fn permute(self, indices: Self::Indices) -> Self;
}

/// A vector of sixteen f32: what tests against boxes and packets of rays need.
pub trait Lanes: Vector {
    /// The vector for leaves whose vertices and triangles all fit into its lanes; half as wide where testing two
    /// registers takes twice as long as testing one.
    type Narrow: Vector;

    /// The vector for loops over blocks of numbers: the widest that is one register.
    type Block: Block;

    /// Whether tracing packets of rays is faster than tracing them one by one.
    const USES_PACKETS: bool;

    /// Whether a branch that skips `compress_children` for an empty mask is faster than calling it.
    const SKIPS_EMPTY: bool;

    /// Runs a kernel in a function of its own that is compiled for this vector's instructions.
    fn call<K: Kernel>(
        data: &K::Data,
        scratch: &mut K::Scratch,
        input: &K::Input,
        kernel: K,
    ) -> K::Output;

    fn load(x: &[f32; LANES]) -> Self;
    fn to_array(self) -> [f32; LANES];
    /// Number i of all records, for each i.
    fn transpose(records: &[[f32; 8]; LANES]) -> [Self; 8];
    /// Lanes where `self < other`; false where either is NaN.
    fn lt(self, other: Self) -> Mask;
    /// `other` in the lanes of `mask`, `self` elsewhere.
    fn blend(self, mask: Mask, other: Self) -> Self;
    /// The smallest number; unspecified if one is NaN.
    fn reduce_min(self) -> f32;
    /// The largest number; unspecified if one is NaN.
    fn reduce_max(self) -> f32;
    /// The smallest number of each of four vectors, and the largest; unspecified if one is NaN.
    #[inline(always)]
    fn reduce_min_max([a, b, c, d]: [Self; 4]) -> [[f32; 4]; 2] {
        [
            [a.reduce_min(), b.reduce_min(), c.reduce_min(), d.reduce_min()],
            [a.reduce_max(), b.reduce_max(), c.reduce_max(), d.reduce_max()],
        ]
    }
    /// The number of one lane in all lanes.
    fn broadcast(self, lane: u32) -> Self;
    /// The same as a [`Lanes::Narrow`].
    fn broadcast_narrow(self, lane: u32) -> Self::Narrow;

    // Children are visited in the order of lanes `i ^ flip`, where `flip` depends on the ray's direction. Where
    // permuting vectors is cheap, `flip` permutes them before they are compared. Elsewhere it is a no-op, and
    // `flip_mask` permutes the result of the comparison instead.

    /// Lane `i` of the result is lane `i ^ flip` of `self`; or `self`, where [`Lanes::flip_mask`] does the work.
    fn flip(self, flip: u32) -> Self;
    /// Flips the mask that comparing [flipped](Lanes::flip) vectors gave, if those were left as they are.
    #[inline(always)]
    fn flip_mask(mask: Mask, _flip: u32) -> Mask {
        mask
    }
    /// For each lane of `mask`, lowest first, writes the child of slot `lane ^ flip` to `ids` and that lane of `self`
    /// to `distances`. `self` is [flipped](Lanes::flip). What comes behind as many entries as `mask` has lanes is
    /// unspecified.
    #[inline(always)]
    fn compress_children(
        self,
        mask: Mask,
        children: &[u32; LANES],
        flip: u32,
        ids: &mut [u32; LANES],
        distances: &mut [f32; LANES],
    ) {
        let child = |lane: u32| children[(lane ^ flip) as usize % LANES];
        compress(mask, self.to_array(), child, ids, distances);
    }
    /// As [`Lanes::compress_children`], with `first + slot` in place of the child of a slot.
    #[inline(always)]
    fn compress_slots(
        self,
        mask: Mask,
        first: u32,
        flip: u32,
        ids: &mut [u32; LANES],
        distances: &mut [f32; LANES],
    ) {
        compress(mask, self.to_array(), |lane| first + (lane ^ flip), ids, distances);
    }
}

/// Writes id and distance of each lane of `mask` next to each other.
#[inline(always)]
fn compress(
    mut mask: Mask,
    from: [f32; LANES],
    id: impl Fn(u32) -> u32,
    ids: &mut [u32; LANES],
    distances: &mut [f32; LANES],
) {
    for (to_id, to_distance) in ids.iter_mut().zip(distances) {
        if mask == 0 {
            return;
        }
        let lane = mask.trailing_zeros();
        (*to_id, *to_distance) = (id(lane), from[lane as usize % LANES]);
        mask &= mask - 1;
    }
}

/// Each coordinate in all lanes of its vector. Spelt out, because `map` is not always inlined.
#[inline(always)]
pub fn splat3<L: Vector>([x, y, z]: [f32; 3]) -> [L; 3] {
    [L::splat(x), L::splat(y), L::splat(z)]
}
