//! [`Candidates`]: one ray against the triangles of a leaf.

use std::hint::black_box;

use super::space::Space;
use crate::accel::tree::Leaf;
use crate::shape::{Crossing, Edges, Reach, ShearedRay, TriangleHit};
use crate::simd::{LaneMask, Lanes, Mask, Pick, Vector, splat3};

/// The triangles of a leaf that a ray hits, or may hit.
pub struct Candidates<V> {
    /// Their lanes.
    pub lanes: Mask,
    /// Those of them that need the scalar test: an edge function is zero, or t is not sure.
    pub undecided: Mask,
    /// Where the ray hits each.
    pub crossing: Crossing<V>,
}

/// The triangles of a leaf that a ray hits no later than `t_max`, among those of as many lanes as [`Lanes::Narrow`] has from
/// `first` on.
#[inline(always)]
pub fn candidates<L: Lanes, S: Space>(
    space: S,
    sheared: &ShearedRay,
    leaf: Leaf,
    first: usize,
    t_min: f32,
    t_max: f32,
) -> Option<Candidates<L::Narrow>> {
    // What is spread over vectors is spread anew for each leaf: to keep so many vectors while nodes are walked costs more.
    let sheared = black_box(sheared);
    if leaf.has_vertices_for::<L::Narrow>() {
        among::<L::Narrow, L::Narrow, S>(space, sheared, leaf, first, t_min, t_max)
    } else {
        among::<L, L::Narrow, S>(space, sheared, leaf, first, t_min, t_max)
    }
}

/// With all vertices in lanes of `V`, and triangles in those of `W`.
#[inline(always)]
fn among<V: Vector + Pick<W>, W: Vector, S: Space>(
    space: S,
    sheared: &ShearedRay,
    leaf: Leaf,
    first: usize,
    t_min: f32,
    t_max: f32,
) -> Option<Candidates<W>> {
    let (o, shear) = (splat3(sheared.o), splat3(sheared.shear));
    let ray = ShearedRay { o, axes: sheared.axes, shear };
    // All vertices in the sheared space, of which the corners are picked.
    let [x, y, z]: [V; 3] = space.vertices(leaf, ray.axes);
    let z = ray.z(z);
    let x = ray.sheared(0, x, z);
    let y = ray.sheared(1, y, z);
    let corners = space.order(leaf.corners(first));
    let (x, y) = (pick3(x, corners), pick3(y, corners));
    let edges = Edges::<W>::new(x, y);
    let on_edge = edges.any_zero();
    let lanes = (edges.inside() | on_edge).bits() & leaf.lanes() >> first;
    if lanes == 0 {
        return None;
    }
    let z = pick3(z, corners);
    let crossing = Crossing::new(edges, z, W::splat(sheared.shear[2]));
    let on_edge = on_edge.bits() & lanes;
    // No hit is where t is not positive: a triangle that the ray leaves, or one behind it.
    let lanes = (crossing.t.gt(W::splat(0.0)).bits() & lanes) | on_edge;
    if lanes == 0 {
        return None;
    }
    let reach = Reach::new([x, y, z]);
    let sure = crossing.is_sure(&reach);
    let in_range = crossing.is_within(W::splat(t_min), W::splat(t_max));
    let hit = (in_range | !sure) & W::Mask::from_bits(lanes);
    let in_front = crossing.is_in_front(&reach, hit) & hit;
    let undecided = (in_front & !sure).bits() | on_edge;
    Some(Candidates { lanes: in_front.bits() | undecided, undecided, crossing })
}

/// Lanes of a vector by the indices of the first, second and third corner.
#[inline(always)]
pub fn pick3<V: Vector + Pick<W>, W: Vector>(x: V, [a, b, c]: [W::Indices; 3]) -> [W; 3] {
    [x.pick(a), x.pick(b), x.pick(c)]
}

/// The scalar test of one triangle of a leaf.
#[inline(always)]
pub fn intersect_triangle<S: Space>(
    space: S,
    sheared: &ShearedRay,
    leaf: Leaf,
    lane: u32,
    t_min: f32,
    t_max: f32,
) -> Option<TriangleHit> {
    let corners = space.order(leaf.corners_of(lane));
    sheared.intersect_at(|axis| space.coordinates(leaf, corners, axis), t_min, t_max)
}
