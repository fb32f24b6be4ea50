//! [`Triangles`]: what leaves hold.

use glam::Vec3;

use super::lanes::{LANES, Lanes, Mask};
use super::node::Child;

/// A triangle, with its number among all triangles of all meshes.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    pub corners: [Vec3; 3],
    pub number: u32,
}

/// The triangles of all leaves, leaf after leaf.
///
/// Each leaf has nine columns, one for each coordinate of each corner, as long as it has triangles: nothing
/// is wasted on leaves that are not full. A vector that is loaded from a column holds, above the leaf's own
/// lanes, what comes next; those lanes are not looked at.
#[derive(Clone, Debug)]
pub struct Triangles {
    columns: Vec<f32>,
    numbers: Vec<u32>,
}

/// The columns of one leaf.
#[derive(Clone, Copy)]
pub struct Leaf<'a> {
    columns: &'a [f32],
    pub count: usize,
}

const COLUMNS: usize = 9;

impl Triangles {
    /// No triangles yet, but for one that no ray hits; see [`Child::NOTHING`].
    pub fn with_capacity(count: usize) -> Self {
        let mut columns = Vec::with_capacity(COLUMNS * (count + 1) + LANES);
        columns.extend([f32::NAN; COLUMNS]);
        let mut numbers = Vec::with_capacity(count + 1);
        numbers.push(u32::MAX);
        Self { columns, numbers }
    }

    /// Adds a leaf; what a node refers to it by.
    pub fn push(&mut self, leaf: &[Triangle]) -> u32 {
        for corner in 0..3 {
            for axis in 0..3 {
                self.columns.extend(leaf.iter().map(|t| t.corners[corner][axis]));
            }
        }
        let first = self.numbers.len();
        self.numbers.extend(leaf.iter().map(|t| t.number));
        Child::leaf(first..self.numbers.len())
    }

    /// Adds the leaves of another; by how much its places moved up.
    pub fn append(&mut self, other: &Self) -> usize {
        let moved = self.len();
        self.columns.extend_from_slice(&other.columns[COLUMNS..]);
        self.numbers.extend_from_slice(&other.numbers[1..]);
        moved
    }

    /// Adds what the last columns of the last leaf need to be loaded as whole vectors.
    pub fn finish(&mut self) {
        self.columns.extend([0.0; LANES]);
    }

    /// How many there are that rays can hit.
    pub fn len(&self) -> usize {
        self.numbers.len() - 1
    }

    pub fn memory(&self) -> usize {
        size_of_val(&self.columns[..]) + size_of_val(&self.numbers[..])
    }

    #[inline(always)]
    pub fn number(&self, place: u32) -> u32 {
        self.numbers[place as usize]
    }

    #[inline(always)]
    pub fn leaf(&self, first: u32, count: usize) -> Leaf<'_> {
        let first = COLUMNS * first as usize;
        Leaf { columns: &self.columns[first..first + COLUMNS * count + LANES], count }
    }
}

impl<'a> Leaf<'a> {
    /// One coordinate of each corner of all triangles, and what comes behind them.
    #[inline(always)]
    pub fn columns<L: Lanes>(self, axis: usize) -> [L; 3] {
        let (first, corner) = (axis * self.count, 3 * self.count);
        debug_assert!(first + 2 * corner + LANES <= self.columns.len());
        // SAFETY: axis is below 3, so that no column begins after the ninth, and LANES numbers follow it.
        unsafe {
            let column = self.columns.as_ptr().add(first);
            [
                L::load_from(column),
                L::load_from(column.add(corner)),
                L::load_from(column.add(2 * corner)),
            ]
        }
    }

    /// The lanes of vectors that are the leaf's own.
    #[inline(always)]
    pub fn lanes(self) -> Mask {
        Mask::MAX >> ((LANES - self.count) % LANES)
    }

    /// One coordinate of one corner of one triangle.
    #[inline(always)]
    pub fn coordinate(self, lane: u32, corner: usize, axis: usize) -> f32 {
        self.columns[(3 * corner + axis) * self.count + lane as usize]
    }
}
