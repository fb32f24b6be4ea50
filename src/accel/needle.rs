//! [`Needle`]: a ray against the triangles of a leaf.

use super::edges::edge;
use super::lanes::{Mask, Vector, splat3};
use super::triangles::Leaf;
use crate::shape::{ShearedRay, TriangleHit};

/// A ray prepared for triangles.
pub struct Needle<L> {
    pub axes: [usize; 3],
    pub o: [L; 3],
    pub shear: [L; 3],
    pub t_min: L,
}

/// Triangles that the ray meets, or may meet.
pub struct Met<L> {
    /// All of them.
    pub lanes: Mask,
    /// Those of them where an edge function is zero, which only the test of one triangle can tell.
    pub unsure: Mask,
    /// Where the ray meets each.
    pub t: L,
}

impl<L: Vector> Needle<L> {
    #[inline(always)]
    pub fn new(sheared: &ShearedRay, t_min: f32) -> Self {
        Self {
            axes: sheared.axes,
            o: splat3(sheared.o),
            shear: splat3(sheared.shear),
            t_min: L::splat(t_min),
        }
    }

    /// The triangles that the ray meets no later than `t_max`, but for the bound on the error of t.
    ///
    /// All lanes compute what [`ShearedRay::intersect`] computes, to the bit.
    #[inline(always)]
    pub fn meets(&self, leaf: Leaf, t_max: L) -> Option<Met<L>> {
        // All vertices in the space where the ray starts at the origin and runs along z, and then what the
        // corners are of them.
        let z = leaf.vertices::<L>(self.axes[2]).sub(self.o[2]);
        let x = leaf.vertices::<L>(self.axes[0]).sub(self.o[0]).add(self.shear[0].mul(z));
        let y = leaf.vertices::<L>(self.axes[1]).sub(self.o[1]).add(self.shear[1].mul(z));
        let [a, b, c] = leaf.corners::<L::Places>();
        let (xa, xb, xc) = (x.at(a), x.at(b), x.at(c));
        let (ya, yb, yc) = (y.at(a), y.at(b), y.at(c));
        let (e0, e1, e2) = (edge(xb, yb, xc, yc), edge(xc, yc, xa, ya), edge(xa, ya, xb, yb));
        let zero = L::splat(0.0);
        let unsure = e0.eq(zero) | e1.eq(zero) | e2.eq(zero);
        let inside = zero.le(e0.min(e1.min(e2))) | e0.max(e1.max(e2)).le(zero);
        let lanes = (inside | unsure) & leaf.lanes();
        if lanes == 0 {
            return None;
        }
        let determinant = e0.add(e1).add(e2);
        let sum = e0.mul(z.at(a)).add(e1.mul(z.at(b))).add(e2.mul(z.at(c)));
        let depth = sum.div(determinant);
        let t = depth.mul(self.shear[2]);
        let in_range = self.t_min.le(t) & t.le(t_max);
        let unsure = unsure & lanes;
        Some(Met { lanes: lanes & in_range | unsure, unsure, t })
    }
}

/// The test of one triangle of a leaf.
#[inline(always)]
pub fn hit(
    sheared: &ShearedRay,
    leaf: Leaf,
    lane: u32,
    t_min: f32,
    t_max: f32,
) -> Option<TriangleHit> {
    let corners = leaf.corners_of(lane);
    sheared.intersect_at(|axis| leaf.coordinates(corners, axis), t_min, t_max)
}
