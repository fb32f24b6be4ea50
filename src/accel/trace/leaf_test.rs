//! [`LeafTest`]: one ray against the triangles of a leaf.

use super::watertight::edge_function;
use crate::accel::tree::Leaf;
use crate::shape::{ShearedRay, TriangleHit};
use crate::simd::{Mask, Vector, splat3};

/// A ray prepared for the triangles of leaves, all of which it tests at once.
pub struct LeafTest<V> {
    /// The axes that become x, y and z.
    pub axes: [usize; 3],
    pub o: [V; 3],
    pub shear: [V; 3],
    pub t_min: V,
}

/// The triangles of a leaf that the ray hits, or may hit.
pub struct Candidates<V> {
    /// Their lanes.
    pub lanes: Mask,
    /// Those of them with an edge function of zero, which need the scalar test and its f64 fallback.
    pub undecided: Mask,
    /// Where the ray hits each.
    pub t: V,
}

impl<V: Vector> LeafTest<V> {
    #[inline(always)]
    pub fn new(sheared: &ShearedRay, t_min: f32) -> Self {
        Self {
            axes: sheared.axes,
            o: splat3(sheared.o),
            shear: splat3(sheared.shear),
            t_min: V::splat(t_min),
        }
    }

    /// The triangles that the ray hits no later than `t_max`, whether or not t exceeds the bound on its error.
    ///
    /// Each lane computes what [`ShearedRay::intersect`] computes, to the bit.
    #[inline(always)]
    pub fn candidates(&self, leaf: Leaf, t_max: V) -> Option<Candidates<V>> {
        // Move and shear all vertices, so that the ray starts at the origin and runs along z. Then pick the corners.
        let z = leaf.vertices::<V>(self.axes[2]).sub(self.o[2]);
        let x = leaf.vertices::<V>(self.axes[0]).sub(self.o[0]).add(self.shear[0].mul(z));
        let y = leaf.vertices::<V>(self.axes[1]).sub(self.o[1]).add(self.shear[1].mul(z));
        let [a, b, c] = leaf.corners::<V::Indices>();
        let (xa, xb, xc) = (x.permute(a), x.permute(b), x.permute(c));
        let (ya, yb, yc) = (y.permute(a), y.permute(b), y.permute(c));
        let e0 = edge_function(xb, yb, xc, yc);
        let e1 = edge_function(xc, yc, xa, ya);
        let e2 = edge_function(xa, ya, xb, yb);
        let zero = V::splat(0.0);
        let on_edge = e0.eq(zero) | e1.eq(zero) | e2.eq(zero);
        let inside = zero.le(e0.min(e1.min(e2))) | e0.max(e1.max(e2)).le(zero);
        let lanes = (inside | on_edge) & leaf.lanes();
        if lanes == 0 {
            return None;
        }
        let determinant = e0.add(e1).add(e2);
        let sum = e0.mul(z.permute(a)).add(e1.mul(z.permute(b))).add(e2.mul(z.permute(c)));
        let depth = sum.div(determinant);
        let t = depth.mul(self.shear[2]);
        let in_range = self.t_min.le(t) & t.le(t_max);
        let undecided = on_edge & lanes;
        Some(Candidates { lanes: lanes & in_range | undecided, undecided, t })
    }
}

/// The scalar test of one triangle of a leaf.
#[inline(always)]
pub fn intersect_triangle(
    sheared: &ShearedRay,
    leaf: Leaf,
    lane: u32,
    t_min: f32,
    t_max: f32,
) -> Option<TriangleHit> {
    let corners = leaf.corners_of(lane);
    sheared.intersect_at(|axis| leaf.coordinates(corners, axis), t_min, t_max)
}
