//! [`Node`], and the encoding of its children.

use super::aabb::Aabb;
use crate::simd::{ARITY, LANES};

/// The boxes of up to eight children, and references to them: four cache lines, with what is left of the last. Sorted by
/// surface area, the largest last: Nah and Manocha 2014, "SATO: Surface Area Traversal Order for Shadow Ray Tracing".
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Node {
    /// The smallest x, y and z of each child's box, then the largest; +∞ and -∞ in empty slots.
    pub planes: [[f32; ARITY]; 6],
    /// [`Child`] of each slot, encoded.
    pub children: [u32; ARITY],
}

/// A child, which takes 32 bits in a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Child {
    /// Index of a node.
    Node(u32),
    /// Index of a leaf, and how many vertices it has.
    Leaf { index: u32, vertices: usize },
}

const LEAF: u32 = 1 << 31;
const VERTICES_SHIFT: u32 = 27;
/// Leaf indices are below this.
const MAX_LEAVES: u32 = 1 << VERTICES_SHIFT;
/// Maximum number of triangles of a tree. Leaves are addressed by the cache line, and one with a single triangle takes
/// two; the sentinel of empty slots is one too.
pub const MAX_TRIANGLES: usize = MAX_LEAVES as usize / 2 - 1;

impl Child {
    /// Sentinel for empty slots: the first leaf. Only NaN rays reach its NaN triangle.
    pub const EMPTY: u32 = LEAF;

    /// Adds offsets to the index of a node or leaf, for a tree that is appended to others.
    pub fn offset(bits: u32, nodes: usize, leaves: usize) -> u32 {
        match bits {
            Self::EMPTY => bits,
            bits if bits & LEAF == 0 => bits + nodes as u32,
            bits => bits + leaves as u32,
        }
    }

    /// Encodes a leaf of 1 to 16 vertices.
    pub fn pack_leaf(index: usize, vertices: usize) -> u32 {
        debug_assert!((1..=LANES).contains(&vertices) && index < MAX_LEAVES as usize);
        LEAF | (vertices as u32 - 1) << VERTICES_SHIFT | index as u32
    }

    /// Decodes a child.
    #[inline(always)]
    pub fn unpack(bits: u32) -> Self {
        if bits & LEAF == 0 {
            return Self::Node(bits);
        }
        let (index, vertices) = Self::unpack_leaf(bits);
        Self::Leaf { index, vertices }
    }

    /// Index and number of vertices of a child that is a leaf.
    #[inline(always)]
    pub fn unpack_leaf(bits: u32) -> (u32, usize) {
        (bits % MAX_LEAVES, (bits >> VERTICES_SHIFT) as usize % LANES + 1)
    }
}

impl Node {
    /// A node without children.
    pub const EMPTY: Self = {
        let (low, high) = ([f32::INFINITY; ARITY], [f32::NEG_INFINITY; ARITY]);
        Self { planes: [low, low, low, high, high, high], children: [Child::EMPTY; ARITY] }
    };

    /// Puts a child into a slot.
    pub fn set(&mut self, slot: usize, bounds: &Aabb, child: u32) {
        for axis in 0..3 {
            self.planes[axis][slot] = bounds.min[axis];
            self.planes[3 + axis][slot] = bounds.max[axis];
        }
        self.children[slot] = child;
    }

    /// The box around all children.
    pub fn bounds(&self) -> Aabb {
        let least = |axis: usize| self.planes[axis].iter().copied().fold(f32::INFINITY, f32::min);
        let most =
            |axis: usize| self.planes[3 + axis].iter().copied().fold(f32::NEG_INFINITY, f32::max);
        Aabb { min: [0, 1, 2].map(least).into(), max: [0, 1, 2].map(most).into() }
    }

    /// Half the surface area of the box of each child that is a leaf.
    pub fn leaf_half_areas(&self) -> impl Iterator<Item = f32> {
        let is_leaf = |slot: &usize| {
            let child = self.children[*slot];
            child != Child::EMPTY && child & LEAF != 0
        };
        (0..ARITY).filter(is_leaf).map(|slot| {
            let [x, y, z] =
                [0, 1, 2].map(|axis| self.planes[axis + 3][slot] - self.planes[axis][slot]);
            x * y + y * z + z * x
        })
    }
}
