//! Triangles with equal boxes, which no tree can tell apart, become one primitive.

use std::ops::Range;

use obvhs::Boundable;
use obvhs::aabb::Aabb;

use crate::accel::tree::Triangle;

/// More triangles than this with equal boxes become one primitive.
const MAX_EQUAL: u8 = 16;

/// A primitive of the binary tree: almost always one triangle, else all triangles of equal boxes.
///
/// PLOC merges two clusters if each is the other's nearest. Among triangles with equal boxes each prefers the next, so
/// that every pass over all of them merges one pair: it takes quadratic time, and the tree becomes a chain.
#[derive(Clone, Copy)]
pub struct Primitive {
    first: u32,
    count: u32,
    bounds: Aabb,
}

impl Primitive {
    fn new(triangles: &[Triangle], first: usize, count: usize) -> Self {
        let boxes = triangles[first..first + count].iter().map(Triangle::bounds);
        let bounds = boxes.fold(Aabb::empty(), |all, one| all.union(&one));
        Self { first: first as u32, count: count as u32, bounds }
    }

    /// Indices of its triangles.
    pub fn triangles(&self) -> Range<u32> {
        self.first..self.first + self.count
    }
}

impl Boundable for Primitive {
    fn aabb(&self) -> Aabb {
        self.bounds
    }
}

/// Groups triangles into primitives, for which it may reorder them.
pub fn group_duplicates(triangles: &mut [Triangle], primitives: &mut Vec<Primitive>) {
    primitives.clear();
    if !may_have_duplicates(triangles) {
        primitives.extend((0..triangles.len()).map(|i| Primitive::new(triangles, i, 1)));
        return;
    }
    triangles.sort_by_key(hash);
    let mut first = 0;
    for equal in triangles.chunk_by(|a, b| hash(a) == hash(b)) {
        if equal.len() > usize::from(MAX_EQUAL) {
            primitives.push(Primitive::new(triangles, first, equal.len()));
        } else {
            let range = first..first + equal.len();
            primitives.extend(range.map(|i| Primitive::new(triangles, i, 1)));
        }
        first += equal.len();
    }
}

/// Whether more than [`MAX_EQUAL`] triangles share the upper bits of their hashes.
fn may_have_duplicates(triangles: &[Triangle]) -> bool {
    let bits = (2 * triangles.len()).next_power_of_two().ilog2();
    let mut counts = vec![0_u8; 1 << bits];
    triangles.iter().any(|triangle| {
        let count = &mut counts[(hash(triangle) >> (64 - bits)) as usize];
        *count += 1;
        *count > MAX_EQUAL
    })
}

/// A hash of a triangle's box. A collision costs a little time and no hit.
fn hash(triangle: &Triangle) -> u64 {
    let bounds = triangle.bounds();
    let coordinates = bounds.min.to_array().into_iter().chain(bounds.max.to_array());
    // FNV-1a over words, rotated so that upper bits come down.
    let hash = coordinates.fold(0xcbf2_9ce4_8422_2325, |hash: u64, x| {
        (hash ^ u64::from(x.to_bits())).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(23)
    });
    // Fibonacci hashing: the upper bits depend on all bits.
    hash.wrapping_mul(0x9e37_79b9_7f4a_7c15)
}
