//! [`Needle`]: a ray against the triangles of a leaf.

use super::lanes::{Lanes, Mask, splat3};
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

impl<L: Lanes> Needle<L> {
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
        // All corners in the space where the ray starts at the origin and runs along z.
        let z = self.moved(leaf, 2);
        let [x, y] = [self.moved(leaf, 0), self.moved(leaf, 1)];
        let [x, y] = [sheared(x, self.shear[0], z), sheared(y, self.shear[1], z)];
        let corner = |i: usize| [x[i], y[i], z[i]];
        let (a, b, c) = (corner(0), corner(1), corner(2));
        let (e0, e1, e2) = (edge(b, c), edge(c, a), edge(a, b));
        let zero = L::splat(0.0);
        let unsure = e0.eq(zero) | e1.eq(zero) | e2.eq(zero);
        let inside = zero.le(e0.min(e1.min(e2))) | e0.max(e1.max(e2)).le(zero);
        let lanes = (inside | unsure) & leaf.lanes();
        if lanes == 0 {
            return None;
        }
        let determinant = e0.add(e1).add(e2);
        let depth = e0.mul(a[2]).add(e1.mul(b[2])).add(e2.mul(c[2])).div(determinant);
        let t = depth.mul(self.shear[2]);
        let in_range = self.t_min.le(t) & t.le(t_max);
        let unsure = unsure & lanes;
        Some(Met { lanes: lanes & in_range | unsure, unsure, t })
    }

    /// One coordinate of all corners, seen from the origin of the ray.
    #[inline(always)]
    fn moved(&self, leaf: Leaf, i: usize) -> [L; 3] {
        let [a, b, c] = leaf.columns::<L>(self.axes[i]);
        [a.sub(self.o[i]), b.sub(self.o[i]), c.sub(self.o[i])]
    }
}

/// The test of one triangle of a leaf.
#[inline]
pub fn hit(
    sheared: &ShearedRay,
    leaf: Leaf,
    lane: u32,
    t_min: f32,
    t_max: f32,
) -> Option<TriangleHit> {
    sheared.intersect_at(|axis| leaf.coordinates(lane, axis), t_min, t_max)
}

/// Twice the signed area of the triangle (origin, p, q) seen along z.
#[inline(always)]
pub fn edge<L: Lanes>(p: [L; 3], q: [L; 3]) -> L {
    p[0].mul(q[1]).sub(p[1].mul(q[0]))
}

/// x or y of three points, after z was added in proportion.
#[inline(always)]
pub fn sheared<L: Lanes>([a, b, c]: [L; 3], shear: L, z: [L; 3]) -> [L; 3] {
    [a.add(shear.mul(z[0])), b.add(shear.mul(z[1])), c.add(shear.mul(z[2]))]
}
