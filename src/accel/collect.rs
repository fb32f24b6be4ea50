//! The triangles of all meshes, part by part.

use std::num::NonZeroUsize;
use std::ops::Range;

use glam::{Vec3, Vec3A};
use obvhs::aabb::Aabb;

use super::parallel;
use super::split::Cuts;
use super::triangles::Triangle;
use crate::shape::TriangleMesh;

/// A part has about so many triangles: while a tree is built over them, all that is known of them stays
/// near to the processor.
const PART: usize = 1 << 13;
/// More parts than this do not fit into the upper levels of the tree; see [`super::layout`].
const MOST_PARTS: usize = 256;
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

/// All triangles with an area, those of each part next to one another.
pub struct Collected {
    pub triangles: Vec<Triangle>,
    /// How many each part has, which is at least one.
    pub counts: Vec<usize>,
    /// What a place for a child costs above the parts; see [`PRICE`].
    pub price: f32,
}

/// Some triangles of one mesh.
struct Chunk<'a> {
    mesh: &'a TriangleMesh,
    range: Range<usize>,
    /// What to add to a triangle's place for its number among all triangles.
    numbers: u32,
}

/// Collects the triangles. Those of one part keep their order.
pub fn collect(meshes: &[TriangleMesh], threads: NonZeroUsize) -> Collected {
    let cuts = cuts(meshes);
    // First the part of each triangle, and how many are in each; then every triangle to its place.
    let sorted = parallel::map(
        threads,
        chunks(meshes),
        || (),
        |(), chunk| {
            let mut counts = vec![0; cuts.parts()];
            let parts = parts_of(&cuts, &chunk);
            for &part in parts.iter().filter(|&&part| part != NOWHERE) {
                counts[usize::from(part)] += 1;
            }
            (chunk, parts, counts)
        },
    );
    let counts: Vec<usize> = (0..cuts.parts())
        .map(|part| sorted.iter().map(|(_, _, counts)| counts[part]).sum())
        .collect();
    let blank = Triangle { corners: [Vec3::ZERO; 3], number: 0 };
    let mut triangles = vec![blank; counts.iter().sum()];
    let mut tasks: Vec<_> = sorted
        .into_iter()
        .map(|(chunk, parts, counts)| (chunk, parts, counts, Vec::with_capacity(cuts.parts())))
        .collect();
    let mut rest = &mut triangles[..];
    for part in 0..cuts.parts() {
        for (_, _, counts, places) in &mut tasks {
            places.push(
                rest.split_off_mut(..counts[part]).expect("as many as were counted").iter_mut(),
            );
        }
    }
    parallel::map(
        threads,
        tasks,
        || (),
        |(), (chunk, parts, _, mut places)| {
            for (i, part) in chunk.range.zip(parts).filter(|&(_, part)| part != NOWHERE) {
                let place = places[usize::from(part)].next().expect("as many as were counted");
                *place =
                    Triangle { corners: chunk.mesh.corners(i), number: chunk.numbers + i as u32 };
            }
        },
    );
    // All children of a single part have room in the root.
    let price = if cuts.parts() == 1 { 0.0 } else { PRICE * cuts.usual_area() };
    Collected { triangles, price, counts: counts.into_iter().filter(|&count| count > 0).collect() }
}

fn chunks(meshes: &[TriangleMesh]) -> Vec<Chunk<'_>> {
    let mut chunks = Vec::new();
    let mut numbers = 0;
    for mesh in meshes {
        let count = mesh.indices.len();
        let ranges = (0..count).step_by(AT_ONCE).map(|i| i..count.min(i + AT_ONCE));
        chunks.extend(ranges.map(|range| Chunk { mesh, range, numbers }));
        numbers += count as u32;
    }
    chunks
}

/// Cuts that some of the triangles ask for.
fn cuts(meshes: &[TriangleMesh]) -> Cuts {
    let count: usize = meshes.iter().map(|mesh| mesh.indices.len()).sum();
    let parts = (count / PART).clamp(1, MOST_PARTS);
    let step = (count / (parts * SAMPLES)).max(1);
    let mut boxes = Vec::new();
    if parts > 1 {
        for mesh in meshes {
            let some = (0..mesh.indices.len()).step_by(step);
            boxes.extend(some.map(|i| bounds(&mesh.corners(i))));
        }
    }
    Cuts::new(&mut boxes, parts)
}

/// The part of each triangle.
fn parts_of(cuts: &Cuts, chunk: &Chunk) -> Vec<u16> {
    const ABREAST: usize = 16;
    let (mesh, end) = (chunk.mesh, chunk.range.end);
    let mut parts = Vec::with_capacity(chunk.range.len() + ABREAST);
    for first in chunk.range.clone().step_by(ABREAST) {
        // Beyond the end the last one again.
        let triangles: [usize; ABREAST] = std::array::from_fn(|i| (first + i).min(end - 1));
        let found = cuts.parts_of(&triangles.map(|i| bounds(&mesh.corners(i))));
        let is_flat = |i: usize| mesh.geometric_normal(i) == Vec3::ZERO;
        parts.extend(
            triangles.iter().zip(found).map(
                |(&i, part)| {
                    if is_flat(i) { NOWHERE } else { part as u16 }
                },
            ),
        );
    }
    parts.truncate(chunk.range.len());
    parts
}

fn bounds(corners: &[Vec3; 3]) -> Aabb {
    let [a, b, c] = corners.map(Vec3A::from);
    Aabb { min: a.min(b).min(c), max: a.max(b).max(c) }
}
