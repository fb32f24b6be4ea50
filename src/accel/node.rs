//! [`Node`], and what its children are.

use super::Aabb;
use super::lanes::LANES;

/// The boxes of up to sixteen children, and what they are.
///
/// A child's slot tells roughly where it lies: its three upper bits are the octant of the node, x lowest.
/// So a ray that runs forwards along all axes meets the slots about in their order, and any other ray meets
/// slot `i ^ flip` as the i-th, where `flip` has the bits of the axes that it runs along backwards.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Node {
    /// Lowest x, y and z, then highest x, y and z, of each child; +∞ and -∞ where there is none.
    pub planes: [[f32; LANES]; 6],
    pub children: [u32; LANES],
}

/// What a child is, in 32 bits: the number of a node, or a leaf's place and how many vertices it has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Child {
    Node(u32),
    Leaf { place: u32, vertices: usize },
}

const LEAF: u32 = 1 << 31;
const VERTICES_SHIFT: u32 = 27;
const PLACES: u32 = 1 << VERTICES_SHIFT;
/// How many triangles can be numbered: if each had a leaf, it would take two places.
pub const MOST_TRIANGLES: usize = PLACES as usize / 2;

impl Child {
    /// The leaf at the first place, whose one triangle no ray hits. Only rays that are not numbers see it.
    pub const NOTHING: u32 = LEAF;

    /// The child in a part whose nodes and leaves were moved up by so many.
    pub fn moved(bits: u32, nodes: usize, leaves: usize) -> u32 {
        match bits {
            Self::NOTHING => bits,
            bits if bits & LEAF == 0 => bits + nodes as u32,
            bits => bits + leaves as u32,
        }
    }

    pub fn leaf(place: usize, vertices: usize) -> u32 {
        debug_assert!((1..=LANES).contains(&vertices) && place < PLACES as usize);
        LEAF | (vertices as u32 - 1) << VERTICES_SHIFT | place as u32
    }

    #[inline(always)]
    pub fn new(bits: u32) -> Self {
        if bits & LEAF == 0 {
            return Self::Node(bits);
        }
        let (place, vertices) = Self::place(bits);
        Self::Leaf { place, vertices }
    }

    /// The place of a leaf, and how many vertices it has.
    #[inline(always)]
    pub fn place(leaf: u32) -> (u32, usize) {
        (leaf % PLACES, (leaf >> VERTICES_SHIFT) as usize % LANES + 1)
    }
}

impl Node {
    /// A node without children.
    pub const EMPTY: Self = {
        let (low, high) = ([f32::INFINITY; LANES], [f32::NEG_INFINITY; LANES]);
        Self { planes: [low, low, low, high, high, high], children: [Child::NOTHING; LANES] }
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

    /// Half the surface areas of the boxes of leaves.
    pub fn leaf_areas(&self) -> impl Iterator<Item = f32> {
        let is_leaf = |slot: &usize| {
            let child = self.children[*slot];
            child != Child::NOTHING && child & LEAF != 0
        };
        (0..LANES).filter(is_leaf).map(|slot| {
            let [x, y, z] =
                [0, 1, 2].map(|axis| self.planes[axis + 3][slot] - self.planes[axis][slot]);
            x * y + y * z + z * x
        })
    }
}
