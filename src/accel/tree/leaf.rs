//! [`Leaf`]: the triangles of one leaf, as traversal reads them.

use std::slice::from_raw_parts;

use crate::simd::{LANES, LaneIndices, Mask, Vector};

/// Words of a leaf besides its vertices and the ids of its triangles.
pub const HEADER: usize = 7;

/// One leaf of [`super::Leaves`], whose documentation has the layout of the words.
#[derive(Clone, Copy)]
pub struct Leaf<'a> {
    /// `3 * vertices + HEADER + LANES` words: the longest that a leaf can be.
    words: &'a [f32],
    vertices: usize,
}

impl<'a> Leaf<'a> {
    /// The leaf that begins at a word.
    #[inline(always)]
    pub fn new(words: &'a [f32], first: usize, vertices: usize) -> Self {
        Self { words: &words[first..first + 3 * vertices + HEADER + LANES], vertices }
    }

    /// One coordinate of all vertices. Lanes above those hold what comes next in memory.
    #[inline(always)]
    #[allow(unsafe_code)]
    pub fn vertices<V: Vector>(self, axis: usize) -> V {
        // SAFETY: at least HEADER + LANES words come after the first `2 * vertices`, since `new` checked the length, and
        // a vector has at most LANES. Slicing in place of the pointer checks each of three loads per leaf again.
        V::load(unsafe {
            from_raw_parts(self.words.as_ptr().add(axis % 3 * self.vertices), V::LANES)
        })
    }

    /// Which vertices the first, second and third corner of the triangles from `first` on are, an even number below 16.
    #[inline(always)]
    pub fn corners<I: LaneIndices>(self, first: usize) -> [I; 3] {
        let words = &self.words[3 * self.vertices..][..6];
        let pair = |i: usize| [words[i], words[i + 1]].map(|word| word.to_bits() >> (2 * first));
        [I::unpack(pair(0)), I::unpack(pair(2)), I::unpack(pair(4))]
    }

    /// Number of triangles, from 1 to 16.
    #[inline(always)]
    pub fn triangles(self) -> usize {
        self.words[3 * self.vertices + HEADER - 1].to_bits() as usize
    }

    /// Whether a kind of vector has lanes for all vertices.
    #[inline(always)]
    pub fn has_vertices_for<V: Vector>(self) -> bool {
        V::LANES == LANES || self.vertices <= V::LANES
    }

    /// The lanes that have triangles.
    #[inline(always)]
    pub fn lanes(self) -> Mask {
        0xffff >> ((LANES - self.triangles()) % LANES)
    }

    /// The id of the triangle in a lane.
    #[inline(always)]
    pub fn id(self, lane: u32) -> u32 {
        self.words[3 * self.vertices + HEADER + lane as usize % LANES].to_bits()
    }

    /// Which vertices the corners of the triangle in a lane are.
    #[inline(always)]
    pub fn corners_of(self, lane: u32) -> [usize; 3] {
        let words = &self.words[3 * self.vertices + lane as usize % 2..][..5];
        let shift = 4 * (lane / 2 % 8);
        let corner = |word: f32| (word.to_bits() >> shift & 15) as usize;
        [corner(words[0]), corner(words[2]), corner(words[4])]
    }

    /// One coordinate of three vertices.
    #[inline(always)]
    pub fn coordinates(self, [a, b, c]: [usize; 3], axis: usize) -> [f32; 3] {
        let x = &self.words[axis * self.vertices..][..LANES];
        [x[a % LANES], x[b % LANES], x[c % LANES]]
    }
}
