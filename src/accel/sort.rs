//! Which triangles are in which part.

use std::num::NonZeroUsize;
use std::ops::Range;

use arrayvec::ArrayVec;
use glam::Vec3;
use obvhs::aabb::Aabb;

use super::parallel;
use super::source::Source;
use super::split::Cuts;
use super::triangles::Triangle;
use crate::shape::triangle_normal;

/// A part has about so many triangles: while a tree is built over them, all that is known of them, a few
/// hundred bytes each, stays near to the processor.
const PART: usize = 1 << 13;
/// There are no more parts than this: the levels above them are few; see [`super::top`].
pub const MOST_PARTS: usize = 256;
/// So many triangles of each part say where to cut.
const SAMPLES: usize = 256;

/// What a child costs the nodes above the parts, in the usual area of a part. So most parts become one child
/// of the tree above, and those with a large box, such as one around half of a floor, become several. As
/// measured: the sum of all areas changes little from half of this to twice.
const PRICE: f32 = 1.0 / 3.0;

/// Triangles are looked at so many at a time.
const AT_ONCE: usize = 1 << 14;

/// The part of triangles without area.
const NOWHERE: u16 = u16::MAX;

/// The numbers of all triangles with an area, those of each part next to one another.
pub struct Sorted {
    /// They ascend within a part.
    pub numbers: Vec<u32>,
    /// How many each part has, which is at least one.
    pub counts: Vec<usize>,
    /// What a place for a child costs above the parts; see [`PRICE`].
    pub price: f32,
}

/// Some triangles.
struct Chunk {
    numbers: Range<u32>,
    /// The part of each.
    parts: Vec<u16>,
    /// How many there are of each part.
    counts: Vec<usize>,
}

/// Sorts the triangles into parts.
pub fn sort(source: &Source, threads: NonZeroUsize) -> Sorted {
    let cuts = cuts(source);
    // First the part of each triangle, and how many are in each; then the numbers to their places.
    let ranges =
        (0..source.count).step_by(AT_ONCE).map(|i| i..source.count.min(i + AT_ONCE as u32));
    let chunks = parallel::map(
        threads,
        ranges.collect(),
        || (),
        |(), numbers| {
            let parts = parts_of(&cuts, source, numbers.clone());
            let mut counts = vec![0; cuts.parts()];
            for &part in parts.iter().filter(|&&part| part != NOWHERE) {
                counts[usize::from(part)] += 1;
            }
            Chunk { numbers, parts, counts }
        },
    );
    let count = |part: usize| chunks.iter().map(|chunk| chunk.counts[part]).sum();
    let counts: Vec<usize> = (0..cuts.parts()).map(count).collect();
    let mut numbers = vec![0; counts.iter().sum()];
    let mut places: Vec<_> = chunks.iter().map(|_| Vec::with_capacity(cuts.parts())).collect();
    let mut rest = &mut numbers[..];
    for part in 0..cuts.parts() {
        for (chunk, places) in chunks.iter().zip(&mut places) {
            let place = rest.split_off_mut(..chunk.counts[part]).expect("they were counted");
            places.push(place.iter_mut());
        }
    }
    let tasks = chunks.into_iter().zip(places).collect();
    parallel::map(
        threads,
        tasks,
        || (),
        |(), (chunk, mut places)| {
            for (number, part) in
                chunk.numbers.zip(chunk.parts).filter(|&(_, part)| part != NOWHERE)
            {
                *places[usize::from(part)].next().expect("they were counted") = number;
            }
        },
    );
    // All children of a single part have room in the root.
    let price = if cuts.parts() == 1 { 0.0 } else { PRICE * cuts.usual_area() };
    Sorted { numbers, price, counts: counts.into_iter().filter(|&count| count > 0).collect() }
}

/// Cuts that some of the triangles ask for.
fn cuts(source: &Source) -> Cuts {
    let count = source.count as usize;
    let parts = (count / PART).clamp(1, MOST_PARTS);
    let step = (count / (parts * SAMPLES)).max(1);
    let some = (0..source.count).step_by(step).filter(|_| parts > 1);
    let mut boxes: Vec<Aabb> = source.triangles(some).map(|triangle| triangle.bounds()).collect();
    Cuts::new(&mut boxes, parts)
}

/// The part of each triangle.
fn parts_of(cuts: &Cuts, source: &Source, numbers: Range<u32>) -> Vec<u16> {
    const ABREAST: usize = 16;
    let mut parts = Vec::with_capacity(numbers.len());
    let mut triangles = source.triangles(numbers);
    loop {
        let some: ArrayVec<Triangle, ABREAST> = triangles.by_ref().take(ABREAST).collect();
        let Some(last) = some.last() else { return parts };
        let boxes = std::array::from_fn(|i| some.get(i).unwrap_or(last).bounds());
        let found = cuts.parts_of::<ABREAST>(&boxes);
        parts.extend(some.iter().zip(found).map(|(triangle, part)| {
            let is_flat = triangle_normal(triangle.corners) == Vec3::ZERO;
            if is_flat { NOWHERE } else { part as u16 }
        }));
    }
}
