//! [`LeafTest`]: one ray against the triangles of a leaf.

use super::space::Space;
use crate::accel::tree::Leaf;
use crate::shape::{Crossing, Edges, Reach, ShearedRay, TriangleHit};
use crate::simd::{LaneMask, Mask, Vector, splat3};

/// A ray prepared for the triangles of leaves, all of which it tests at once.
pub struct LeafTest<V> {
    ray: ShearedRay<V>,
    t_min: V,
}

/// The triangles of a leaf that the ray hits, or may hit.
pub struct Candidates<V> {
    /// Their lanes.
    pub lanes: Mask,
    /// Those of them that need the scalar test: an edge function is zero, or t is not sure.
    pub undecided: Mask,
    /// Where the ray hits each.
    pub crossing: Crossing<V>,
}

impl<V: Vector> LeafTest<V> {
    #[inline(always)]
    pub fn new(sheared: &ShearedRay, t_min: f32) -> Self {
        // Spread over vectors here, each time, which is cheaper than to keep so many vectors while nodes are walked.
        let sheared = std::hint::black_box(sheared);
        let (o, shear) = (splat3(sheared.o), splat3(sheared.shear));
        Self { ray: ShearedRay { o, axes: sheared.axes, shear }, t_min: V::splat(t_min) }
    }

    /// The triangles that the ray hits no later than `t_max`.
    #[inline(always)]
    pub fn candidates<S: Space>(&self, space: S, leaf: Leaf, t_max: V) -> Option<Candidates<V>> {
        let ray = &self.ray;
        // All vertices in the sheared space, of which the corners are picked.
        let [x, y, z] = space.vertices(leaf, ray.axes);
        let z = ray.z(z);
        let x = ray.sheared(0, x, z);
        let y = ray.sheared(1, y, z);
        let corners = space.order(leaf.corners());
        let (x, y) = (permute3(x, corners), permute3(y, corners));
        let edges = Edges::new(x, y);
        let on_edge = edges.any_zero();
        let lanes = (edges.inside() | on_edge).bits() & leaf.lanes();
        if lanes == 0 {
            return None;
        }
        let z = permute3(z, corners);
        let crossing = Crossing::new(edges, z, ray);
        let on_edge = on_edge.bits() & lanes;
        // Of triangles that a ray leaves or has left behind there is no more to know.
        let lanes = (crossing.t.gt(V::splat(0.0)).bits() & lanes) | on_edge;
        if lanes == 0 {
            return None;
        }
        let reach = Reach::new([x, y, z]);
        let sure = crossing.is_sure(&reach);
        let candidates =
            (crossing.is_within(self.t_min, t_max) | !sure) & V::Mask::from_bits(lanes);
        let in_front = crossing.is_in_front(&reach, candidates) & candidates;
        let undecided = (in_front & !sure).bits() | on_edge;
        Some(Candidates { lanes: in_front.bits() | undecided, undecided, crossing })
    }
}

/// Lanes of a vector by the indices of the first, second and third corner.
#[inline(always)]
pub fn permute3<V: Vector>(x: V, [a, b, c]: [V::Indices; 3]) -> [V; 3] {
    [x.permute(a), x.permute(b), x.permute(c)]
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
