//! [`Triangles`]: what leaves hold.

use glam::{Vec3, Vec3A};
use obvhs::aabb::Aabb;

use super::lanes::{LANES, Lanes, Mask};
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
/// Each leaf has nine columns, one for each coordinate of each corner, as long as it has triangles: nothing
/// is wasted on leaves that are not full. A vector that is loaded from a column holds, above the leaf's own
/// lanes, what comes next; those lanes are not looked at.
#[derive(Clone, Debug)]
pub struct Triangles {
    columns: Vec<f32>,
    numbers: Vec<u32>,
}

/// Room for triangles that follow one another, which is filled leaf by leaf.
pub struct TrianglesMut<'a> {
    columns: &'a mut [f32],
    numbers: &'a mut [u32],
    /// The place of the next triangle among all.
    first: usize,
}

/// The columns of one leaf.
#[derive(Clone, Copy)]
pub struct Leaf<'a> {
    columns: &'a [f32],
    pub count: usize,
}

const COLUMNS: usize = 9;

impl Triangles {
    /// Room for so many triangles, and before them one that no ray hits; see [`Child::NOTHING`].
    pub fn with_room(count: usize) -> Self {
        // The last columns of the last leaf can be loaded as whole vectors.
        let mut columns = vec![0.0; COLUMNS * (count + 1) + LANES];
        columns[..COLUMNS].fill(f32::NAN);
        let mut numbers = vec![0; count + 1];
        numbers[0] = u32::MAX;
        Self { columns, numbers }
    }

    /// Room for so many triangles each, one after another.
    pub fn pieces(&mut self, counts: &[usize]) -> Vec<TrianglesMut<'_>> {
        let (mut columns, mut numbers) = (&mut self.columns[COLUMNS..], &mut self.numbers[1..]);
        let mut first = 1;
        let mut pieces = Vec::with_capacity(counts.len());
        for &count in counts {
            let (columns_here, more_columns) = columns.split_at_mut(COLUMNS * count);
            let (numbers_here, more_numbers) = numbers.split_at_mut(count);
            pieces.push(TrianglesMut { columns: columns_here, numbers: numbers_here, first });
            (columns, numbers) = (more_columns, more_numbers);
            first += count;
        }
        pieces
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

impl TrianglesMut<'_> {
    /// Adds a leaf; what a node refers to it by.
    pub fn push(&mut self, leaf: &[Triangle]) -> u32 {
        let columns = self.columns.split_off_mut(..COLUMNS * leaf.len()).expect("room");
        let mut columns = columns.chunks_exact_mut(leaf.len());
        for corner in 0..3 {
            for axis in 0..3 {
                let column = columns.next().expect("nine columns");
                for (x, triangle) in column.iter_mut().zip(leaf) {
                    *x = triangle.corners[corner][axis];
                }
            }
        }
        let numbers = self.numbers.split_off_mut(..leaf.len()).expect("room");
        for (number, triangle) in numbers.iter_mut().zip(leaf) {
            *number = triangle.number;
        }
        let first = self.first;
        self.first += leaf.len();
        Child::leaf(first..self.first)
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

    /// One coordinate of each corner of one triangle.
    #[inline(always)]
    pub fn coordinates(self, lane: u32, axis: usize) -> [f32; 3] {
        let corner = 3 * self.count;
        let column = &self.columns[axis * self.count + lane as usize..][..=2 * corner];
        [column[0], column[corner], column[2 * corner]]
    }
}
