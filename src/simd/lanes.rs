//! [`Vector`] and [`Lanes`]: what traversal asks of vectors of f32. [`Kernel`]: code that is generic over them.

use super::eight::Eight;
use super::float::{Block, Float};

/// Number of lanes of a [`Lanes`]: most triangles per leaf, rays per packet.
pub const LANES: usize = 16;

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

/// For each lane the index of a lane; operand of [`Pick::pick`].
pub trait LaneIndices: Copy {
    /// Unpacks four bits per lane: even lanes from the first word, odd lanes from the second, lowest lane lowest.
    fn unpack(words: [u32; 2]) -> Self;
}

/// A vector of eight or sixteen f32: what the test of one ray against a leaf needs.
pub trait Vector: Block {
    /// Operand of [`Pick::pick`].
    type Indices: LaneIndices;

    /// The number in one lane.
    fn lane(self, lane: u32) -> f32;
}

/// Lanes of a vector picked into another, which may have fewer.
pub trait Pick<V: Vector> {
    /// Lane `i` of the result is lane `indices[i]` of `self`.
    fn pick(self, indices: V::Indices) -> V;
}

/// A vector of sixteen f32: what tests of large leaves and of packets of rays need.
pub trait Lanes: Vector + Pick<Self> + Pick<Self::Narrow> {
    /// The vector for the triangles of a leaf; half as wide where testing two registers takes twice as long as testing one.
    type Narrow: Vector + Pick<Self::Narrow>;

    /// The vector for loops over blocks of numbers: the widest that is one register.
    type Block: Block;

    /// The vector for the boxes of a node.
    type Boxes: Eight;

    /// Runs a kernel in a function of its own that is compiled for this vector's instructions.
    fn call<K: Kernel>(
        data: &K::Data,
        scratch: &mut K::Scratch,
        input: &K::Input,
        kernel: K,
    ) -> K::Output;

    #[inline(always)]
    fn to_array(self) -> [f32; LANES] {
        let mut x = [0.0; LANES];
        self.store(&mut x);
        x
    }
    /// The smallest number; unspecified if one is NaN.
    fn reduce_min(self) -> f32;
    /// The largest number; unspecified if one is NaN.
    #[inline(always)]
    fn reduce_max(self) -> f32 {
        -(-self).reduce_min()
    }
    /// The smallest number of each of four vectors, and the largest; unspecified if one is NaN.
    #[inline(always)]
    fn reduce_min_max([a, b, c, d]: [Self; 4]) -> [[f32; 4]; 2] {
        [
            [a.reduce_min(), b.reduce_min(), c.reduce_min(), d.reduce_min()],
            [a.reduce_max(), b.reduce_max(), c.reduce_max(), d.reduce_max()],
        ]
    }
}

/// Each coordinate in all lanes of its vector. Spelt out, because `map` is not always inlined.
#[inline(always)]
pub fn splat3<F: Float>([x, y, z]: [f32; 3]) -> [F; 3] {
    [F::splat(x), F::splat(y), F::splat(z)]
}
