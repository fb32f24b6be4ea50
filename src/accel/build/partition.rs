//! [`partition`]: sorts the triangles of a large scene into parts, over which treelets are built.

use std::num::NonZeroUsize;
use std::ops::Range;

use arrayvec::ArrayVec;
use glam::Vec3;
use obvhs::aabb::Aabb;

use super::cuts::Cuts;
use super::parallel;
use super::primitives::Primitives;
use crate::accel::tree::Triangle;
use crate::shape::triangle_normal;

/// About so many triangles are a part: all that is known of them while a treelet is built, a few hundred bytes each,
/// stays in the processor's cache.
const TRIANGLES_PER_PART: usize = 1 << 13;
/// Most parts, so that the levels above the treelets are few.
pub const MAX_PARTS: usize = 256;
/// Triangles sampled per part, from which the cutting planes are found.
const SAMPLES_PER_PART: usize = 256;

/// Cost of a child of the top level, as a multiple of the median area of a part's box. With it most treelets become one
/// child, and those with a large box, such as one around half of a floor, several. Measured: the summed areas change
/// little from half of this to twice.
const CHILD_COST: f32 = 1.0 / 3.0;

/// Triangles per task.
const CHUNK: usize = 1 << 14;

/// Marks triangles without area, which no ray can hit: they belong to no part.
const NO_PART: u16 = u16::MAX;

/// All triangles with an area, part after part.
pub struct Partition {
    /// Ids of the triangles, ascending within a part.
    pub ids: Vec<u32>,
    /// Number of triangles of each part, at least one.
    pub counts: Vec<usize>,
    /// Cost of a child of the top level, in units of area.
    pub child_cost: f32,
}

/// A run of triangles, sorted as one task.
struct Chunk {
    ids: Range<u32>,
    /// The part of each triangle.
    parts: Vec<u16>,
    /// Number of triangles in each part.
    counts: Vec<usize>,
}

/// Sorts the triangles into parts, by counting sort.
pub fn partition(primitives: &Primitives, threads: NonZeroUsize) -> Partition {
    let cuts = find_cuts(primitives);
    // Count: the part of each triangle, and how many are in each part.
    let ranges =
        (0..primitives.count).step_by(CHUNK).map(|i| i..primitives.count.min(i + CHUNK as u32));
    let chunks = parallel::map(
        threads,
        ranges.collect(),
        || (),
        |(), ids| {
            let parts = parts_of(&cuts, primitives, ids.clone());
            let mut counts = vec![0; cuts.parts()];
            for &part in parts.iter().filter(|&&part| part != NO_PART) {
                counts[usize::from(part)] += 1;
            }
            Chunk { ids, parts, counts }
        },
    );
    // Scatter: each chunk has a range of its own in each part.
    let count = |part: usize| chunks.iter().map(|chunk| chunk.counts[part]).sum();
    let counts: Vec<usize> = (0..cuts.parts()).map(count).collect();
    let mut ids = vec![0; counts.iter().sum()];
    let mut ranges: Vec<_> = chunks.iter().map(|_| Vec::with_capacity(cuts.parts())).collect();
    let mut rest = &mut ids[..];
    for part in 0..cuts.parts() {
        for (chunk, ranges) in chunks.iter().zip(&mut ranges) {
            let range = rest.split_off_mut(..chunk.counts[part]).expect("counts add up");
            ranges.push(range.iter_mut());
        }
    }
    let tasks = chunks.into_iter().zip(ranges).collect();
    parallel::map(
        threads,
        tasks,
        || (),
        |(), (chunk, mut ranges)| {
            for (id, part) in chunk.ids.zip(chunk.parts).filter(|&(_, part)| part != NO_PART) {
                *ranges[usize::from(part)].next().expect("counts add up") = id;
            }
        },
    );
    // All children of a single part have room in the root.
    let child_cost = if cuts.parts() == 1 { 0.0 } else { CHILD_COST * cuts.median_half_area() };
    Partition { ids, child_cost, counts: counts.into_iter().filter(|&count| count > 0).collect() }
}

/// Finds the cutting planes from a sample of the triangles.
fn find_cuts(primitives: &Primitives) -> Cuts {
    let count = primitives.count as usize;
    let parts = (count / TRIANGLES_PER_PART).clamp(1, MAX_PARTS);
    let step = (count / (parts * SAMPLES_PER_PART)).max(1);
    let sample = (0..primitives.count).step_by(step).filter(|_| parts > 1);
    let mut boxes: Vec<Aabb> =
        primitives.triangles(sample).map(|triangle| triangle.bounds()).collect();
    Cuts::new(&mut boxes, parts)
}

/// The part of each triangle.
fn parts_of(cuts: &Cuts, primitives: &Primitives, ids: Range<u32>) -> Vec<u16> {
    const AT_ONCE: usize = 16;
    let mut parts = Vec::with_capacity(ids.len());
    let mut triangles = primitives.triangles(ids);
    loop {
        let some: ArrayVec<Triangle, AT_ONCE> = triangles.by_ref().take(AT_ONCE).collect();
        let Some(last) = some.last() else { return parts };
        let boxes = std::array::from_fn(|i| some.get(i).unwrap_or(last).bounds());
        let found = cuts.parts_of::<AT_ONCE>(&boxes);
        parts.extend(some.iter().zip(found).map(|(triangle, part)| {
            let has_no_area = triangle_normal(triangle.corners) == Vec3::ZERO;
            if has_no_area { NO_PART } else { part as u16 }
        }));
    }
}
