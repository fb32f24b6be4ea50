//! [`Triangles`]: what leaves hold.

use arrayvec::ArrayVec;
use glam::{Vec3, Vec3A};
use obvhs::aabb::Aabb;

use super::lanes::{LANES, Mask, Places, Vector};
use super::node::Child;

/// A triangle, with its number among all triangles of all meshes.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    pub corners: [Vec3; 3],
    pub number: u32,
}

impl Triangle {
    pub fn bounds(&self) -> Aabb {
        let [a, b, c] = self.corners.map(Vec3A::from);
        Aabb { min: a.min(b).min(c), max: a.max(b).max(c) }
    }
}

/// The triangles of all leaves, leaf after leaf.
///
/// Neighbours share their vertices, so a leaf holds each vertex once, and for each corner of its triangles
/// which vertex it is. It is a run of words: x of all vertices, then y, then z; for each corner sixteen times
/// four bits in two words ([`Places`]); how many triangles there are; and their numbers. A vector that is
/// loaded from x, y or z holds, above the leaf's own vertices, what comes next, which no corner refers to.
#[derive(Clone, Debug)]
pub struct Triangles {
    words: Vec<f32>,
    count: usize,
}

/// One leaf.
#[derive(Clone, Copy)]
pub struct Leaf<'a> {
    words: &'a [f32],
    vertices: usize,
}

/// Leaves begin at cache lines, as long as the whole does.
const ALIGNMENT: usize = 16;
/// What a leaf has besides vertices and numbers.
const HEAD: usize = 7;

/// Vertices told apart, and for each triangle which of them it has.
struct Shared {
    vertices: ArrayVec<Vec3, LANES>,
    corners: ArrayVec<[u8; 3], LANES>,
}

impl Shared {
    /// None if there are too many.
    fn new<'t>(triangles: impl Iterator<Item = &'t Triangle>) -> Option<Self> {
        let mut shared = Self { vertices: ArrayVec::new(), corners: ArrayVec::new() };
        for triangle in triangles {
            let mut places = [0; 3];
            for (place, p) in places.iter_mut().zip(triangle.corners) {
                let same =
                    |q: &Vec3| q.to_array().map(f32::to_bits) == p.to_array().map(f32::to_bits);
                *place = match shared.vertices.iter().position(same) {
                    Some(place) => place as u8,
                    None => {
                        shared.vertices.try_push(p).ok()?;
                        shared.vertices.len() as u8 - 1
                    }
                };
            }
            shared.corners.try_push(places).ok()?;
        }
        Some(shared)
    }
}

impl Triangles {
    /// None yet, but one that no ray hits; see [`Child::NOTHING`].
    pub fn new() -> Self {
        let nothing = Triangle { corners: [Vec3::NAN; 3], number: u32::MAX };
        let mut triangles = Self { words: Vec::new(), count: 0 };
        triangles.push([&nothing].into_iter());
        triangles.count = 0;
        triangles
    }

    /// Adds a leaf: what a node refers to it by. None if the triangles have too many vertices, which five
    /// never have.
    pub fn push<'t>(
        &mut self,
        leaf: impl ExactSizeIterator<Item = &'t Triangle> + Clone,
    ) -> Option<u32> {
        let Shared { vertices, corners } = Shared::new(leaf.clone())?;
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
        self.count += leaf.len();
        self.words.extend(leaf.map(|triangle| f32::from_bits(triangle.number)));
        self.words.resize(self.words.len().next_multiple_of(ALIGNMENT), 0.0);
        Some(Child::leaf(first / ALIGNMENT, vertices.len()))
    }

    /// Adds the leaves of others, of which the first is left out; by how many places they move up.
    pub fn append(&mut self, other: &Self) -> usize {
        let moved = self.words.len() / ALIGNMENT - NOTHING_WORDS / ALIGNMENT;
        self.words.extend_from_slice(&other.words[NOTHING_WORDS..]);
        self.count += other.count;
        moved
    }

    /// Takes room for the leaves of others.
    pub fn reserve<'t>(&mut self, others: impl Iterator<Item = &'t Self>) {
        self.words.reserve_exact(others.map(|other| other.words.len()).sum::<usize>() + 2 * LANES);
    }

    /// Adds what the last words need to be loaded as whole vectors.
    pub fn finish(&mut self) {
        self.words.extend([0.0; 2 * LANES]);
    }

    /// How many there are that rays can hit.
    pub fn len(&self) -> usize {
        self.count
    }

    pub fn memory(&self) -> usize {
        size_of_val(&self.words[..])
    }

    #[inline(always)]
    pub fn leaf(&self, place: u32, vertices: usize) -> Leaf<'_> {
        let first = ALIGNMENT * place as usize;
        // As long as it may be at most: no vector that is loaded from it reaches beyond.
        Leaf { words: &self.words[first..first + 3 * vertices + HEAD + LANES], vertices }
    }
}

/// The leaf of one triangle with one vertex.
const NOTHING_WORDS: usize = ALIGNMENT;

impl Leaf<'_> {
    /// One coordinate of all vertices, and what comes behind them.
    #[inline(always)]
    pub fn vertices<L: Vector>(self, axis: usize) -> L {
        // SAFETY: behind z there are the head and LANES words, and a vector is no longer than those.
        unsafe { L::load_from(self.words.as_ptr().add(axis % 3 * self.vertices)) }
    }

    /// Which vertices the corners of all triangles are.
    #[inline(always)]
    pub fn corners<P: Places>(self) -> [P; 3] {
        let words = &self.words[3 * self.vertices..][..6];
        let pair = |i: usize| [words[i].to_bits(), words[i + 1].to_bits()];
        [P::new(pair(0)), P::new(pair(2)), P::new(pair(4))]
    }

    /// How many triangles there are.
    #[inline(always)]
    fn count(self) -> usize {
        self.words[3 * self.vertices + HEAD - 1].to_bits() as usize
    }

    /// Whether vectors of a kind have lanes for all vertices and all triangles.
    #[inline(always)]
    pub fn fits<V: Vector>(self) -> bool {
        V::LANES == LANES || self.vertices <= V::LANES && self.count() <= V::LANES
    }

    /// The lanes that have triangles.
    #[inline(always)]
    pub fn lanes(self) -> Mask {
        Mask::MAX >> ((LANES - self.count()) % LANES)
    }

    /// The number of a triangle.
    #[inline(always)]
    pub fn number(self, lane: u32) -> u32 {
        self.words[3 * self.vertices + HEAD + lane as usize % LANES].to_bits()
    }

    /// Which vertices the corners of one triangle are.
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
