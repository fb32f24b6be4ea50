//! [`Leaves`]: the triangles of all leaves.

use arrayvec::ArrayVec;
use glam::Vec3;

use super::leaf::{HEADER, Leaf};
use super::node::Child;
use super::triangle::Triangle;
use crate::simd::LANES;

/// The triangles of all leaves, leaf after leaf.
///
/// Neighbouring triangles share vertices. So a leaf stores each vertex once, at most sixteen, and for each corner of
/// its triangles the index of a vertex. It is a run of words:
/// - x of all vertices, y of all vertices, z of all vertices;
/// - for the first, second and third corner, sixteen indices of four bits in two words ([`LaneIndices`]);
/// - the number of triangles;
/// - the id of each triangle.
///
/// A vector loaded from x, y or z has, in lanes above the leaf's own vertices, the words that come next. No corner
/// refers to those.
///
/// [`LaneIndices`]: crate::simd::LaneIndices
#[derive(Clone, Debug)]
pub struct Leaves {
    words: Vec<f32>,
    triangles: usize,
}

/// Leaves begin at multiples of so many words: a cache line, if the vector begins at one.
const ALIGNMENT: usize = 16;
/// Words of the sentinel leaf, which has one triangle with one vertex.
const SENTINEL: usize = ALIGNMENT;

/// The distinct vertices of a leaf, and for each triangle the indices of its corners.
struct Indexed {
    vertices: ArrayVec<Vec3, LANES>,
    corners: ArrayVec<[u8; 3], LANES>,
}

impl Indexed {
    /// None if there are more vertices or triangles than lanes.
    fn new<'t>(triangles: impl Iterator<Item = &'t Triangle>) -> Option<Self> {
        let mut indexed = Self { vertices: ArrayVec::new(), corners: ArrayVec::new() };
        for triangle in triangles {
            let mut corners = [0; 3];
            for (corner, p) in corners.iter_mut().zip(triangle.corners) {
                let same =
                    |q: &Vec3| q.to_array().map(f32::to_bits) == p.to_array().map(f32::to_bits);
                *corner = match indexed.vertices.iter().position(same) {
                    Some(index) => index as u8,
                    None => {
                        indexed.vertices.try_push(p).ok()?;
                        indexed.vertices.len() as u8 - 1
                    }
                };
            }
            indexed.corners.try_push(corners).ok()?;
        }
        Some(indexed)
    }
}

impl Leaves {
    /// Only the sentinel of [`Child::EMPTY`], whose corners are NaN.
    pub fn new() -> Self {
        let sentinel = Triangle { corners: [Vec3::NAN; 3], id: u32::MAX };
        let mut leaves = Self { words: Vec::new(), triangles: 0 };
        leaves.push([&sentinel].into_iter());
        leaves.triangles = 0;
        leaves
    }

    /// Appends a leaf; returns the encoded [`Child`]. None, with nothing done, if the triangles have more than sixteen
    /// distinct vertices. Five triangles never do.
    pub fn push<'t>(
        &mut self,
        leaf: impl ExactSizeIterator<Item = &'t Triangle> + Clone,
    ) -> Option<u32> {
        let Indexed { vertices, corners } = Indexed::new(leaf.clone())?;
        let first = self.words.len();
        for axis in 0..3 {
            self.words.extend(vertices.iter().map(|vertex| vertex[axis]));
        }
        for corner in 0..3 {
            let mut words = [0_u32; 2];
            for (lane, corners) in corners.iter().enumerate() {
                words[lane % 2] |= u32::from(corners[corner]) << (4 * (lane / 2));
            }
            self.words.extend(words.map(f32::from_bits));
        }
        self.words.push(f32::from_bits(leaf.len() as u32));
        debug_assert_eq!(self.words.len() - first, 3 * vertices.len() + HEADER);
        self.triangles += leaf.len();
        self.words.extend(leaf.map(|triangle| f32::from_bits(triangle.id)));
        self.words.resize(self.words.len().next_multiple_of(ALIGNMENT), 0.0);
        Some(Child::pack_leaf(first / ALIGNMENT, vertices.len()))
    }

    /// Appends the leaves of another, without its sentinel; returns what to add to their indices.
    pub fn append(&mut self, other: &Self) -> usize {
        let offset = self.words.len() / ALIGNMENT - SENTINEL / ALIGNMENT;
        self.words.extend_from_slice(&other.words[SENTINEL..]);
        self.triangles += other.triangles;
        offset
    }

    /// Reserves memory for the leaves of others.
    pub fn reserve<'t>(&mut self, others: impl Iterator<Item = &'t Self>) {
        self.words.reserve_exact(others.map(|other| other.words.len()).sum::<usize>() + 2 * LANES);
    }

    /// Appends padding, so that whole vectors can be loaded from the last leaf too. To be called once, at the end.
    pub fn finish(&mut self) {
        self.words.extend([0.0; 2 * LANES]);
    }

    /// Number of triangles, without the sentinel.
    pub fn triangle_count(&self) -> usize {
        self.triangles
    }

    /// Bytes of the leaves.
    pub fn memory(&self) -> usize {
        size_of_val(&self.words[..])
    }

    /// The leaf of an index with so many vertices, both from a [`Child`].
    #[inline(always)]
    pub fn get(&self, index: u32, vertices: usize) -> Leaf<'_> {
        Leaf::new(&self.words, ALIGNMENT * index as usize, vertices)
    }
}
