//! Triangles in the same place, which no tree can tell apart.

use std::ops::Range;

use obvhs::Boundable;
use obvhs::aabb::Aabb;

use super::triangles::Triangle;

/// More triangles than this with the same box are one to the tree.
const MOST: u8 = 16;

/// A primitive of the binary tree: almost always one triangle.
///
/// The builder pairs neighbours that are each other's cheapest. In a heap of triangles with equal boxes
/// each prefers the next, so that every pass over all of them makes one pair: its time is quadratic in the
/// heap's size, and the tree it makes is a chain. A heap is therefore one primitive.
#[derive(Clone, Copy)]
pub struct Bundle {
    first: u32,
    count: u32,
    bounds: Aabb,
}

impl Bundle {
    fn new(triangles: &[Triangle], first: usize, count: usize) -> Self {
        let boxes = triangles[first..first + count].iter().map(Triangle::bounds);
        let bounds = boxes.fold(Aabb::empty(), |all, one| all.union(&one));
        Self { first: first as u32, count: count as u32, bounds }
    }

    /// Which triangles.
    pub fn range(&self) -> Range<u32> {
        self.first..self.first + self.count
    }
}

impl Boundable for Bundle {
    fn aabb(&self) -> Aabb {
        self.bounds
    }
}

/// Sorts the triangles into bundles. Where there are no heaps, their order is kept.
pub fn bundle(triangles: &mut [Triangle], bundles: &mut Vec<Bundle>) {
    bundles.clear();
    if !may_have_heaps(triangles) {
        bundles.extend((0..triangles.len()).map(|i| Bundle::new(triangles, i, 1)));
        return;
    }
    triangles.sort_by_key(key);
    let mut first = 0;
    for heap in triangles.chunk_by(|a, b| key(a) == key(b)) {
        if heap.len() > usize::from(MOST) {
            bundles.push(Bundle::new(triangles, first, heap.len()));
        } else {
            bundles.extend((first..first + heap.len()).map(|i| Bundle::new(triangles, i, 1)));
        }
        first += heap.len();
    }
}

/// Whether so many triangles have keys with the same upper bits that they may be a heap.
fn may_have_heaps(triangles: &[Triangle]) -> bool {
    let bits = (2 * triangles.len()).next_power_of_two().ilog2();
    let mut counts = vec![0_u8; 1 << bits];
    triangles.iter().any(|triangle| {
        let count = &mut counts[(key(triangle) >> (64 - bits)) as usize];
        *count += 1;
        *count > MOST
    })
}

/// A number that equal boxes share. Others may share it too, which costs a little time and no hit.
fn key(triangle: &Triangle) -> u64 {
    let bounds = triangle.bounds();
    let numbers = bounds.min.to_array().into_iter().chain(bounds.max.to_array());
    // FNV-1a over words, rotated so that upper bits come down.
    let hash = numbers.fold(0xcbf2_9ce4_8422_2325, |hash: u64, x| {
        (hash ^ u64::from(x.to_bits())).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(23)
    });
    // Fibonacci hashing: all bits have a part in the upper ones.
    hash.wrapping_mul(0x9e37_79b9_7f4a_7c15)
}
