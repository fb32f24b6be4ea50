//! [`Slabs`]: one ray against the boxes of a node.

use glam::Vec3A;

use crate::accel::tree::Node;
use crate::geometry::Ray;
use crate::geometry::float::gamma;
use crate::simd::{LANES, LaneMask, Lanes, Mask, splat3};

/// A ray prepared for boxes.
///
/// The triangle test and the distances to planes are rounded, so a ray may hit a triangle whose box it just misses.
/// Therefore every box is padded by a bound on both errors, and no hit is lost. (Of needles, the t that the triangle test
/// tells may be off by more: where a range ends there, the box may be taken to be beyond.) The padding is added to the
/// ray's origin: once for the planes where it enters boxes, once for those where it leaves.
pub struct Slabs<L> {
    origin_near: [L; 3],
    origin_far: [L; 3],
    inverse: [L; 3],
    /// Index of the planes where the ray enters and leaves, on each axis.
    near: [usize; 3],
    far: [usize; 3],
    t_min: L,
    t_max: L,
    /// `t_max` of every lane: boxes that are entered later are skipped.
    pub end: f32,
    /// Lane `i ^ flip` of the boxes becomes lane i, so that those the ray meets first come last.
    pub flip: u32,
    /// The same, with those that the ray meets first coming first.
    pub flip_near_first: u32,
}

/// Factor by which a ray's range is enlarged at both ends, for the rounding of the t that the triangle test tells: two
/// sums of three products, a quotient and a factor.
const TOLERANCE: f32 = 1.0 + 2.0 * gamma(10);

/// The padding of boxes in whose space rays and triangles are tested.
#[inline(always)]
pub fn padding(ray: &Ray, largest_coordinate: f32) -> f32 {
    // In units of half an epsilon, for numbers up to `reach`: a corner that is moved to the ray's origin and sheared is
    // off by up to 6 (two differences, quotient, product, sum); a plane by up to 4 (padded origin, difference, inverse,
    // product). 5 epsilon in all, and a sixth for products of errors.
    let reach = largest_coordinate + ray.o.abs().max_element();
    6.0 * f32::EPSILON * reach
}

impl<L: Lanes> Slabs<L> {
    #[inline(always)]
    pub fn new(ray: &Ray, largest_coordinate: f32) -> Self {
        Self::padded(ray, Vec3A::splat(padding(ray, largest_coordinate)))
    }

    /// With this padding of boxes along each axis.
    #[inline(always)]
    pub fn padded(ray: &Ray, padding: Vec3A) -> Self {
        let padding = padding.copysign(ray.d.into());
        let o = Vec3A::from(ray.o);
        let inverse = Vec3A::ONE / Vec3A::from(ray.d);
        // By the sign bit, so that -0 counts as negative.
        let negative = Vec3A::from(ray.d).is_negative_bitmask();
        let is_negative = [0, 1, 2].map(|axis| negative as usize >> axis & 1);
        Self {
            origin_near: splat3((o + padding).to_array()),
            origin_far: splat3((o - padding).to_array()),
            inverse: splat3(inverse.to_array()),
            near: [0, 1, 2].map(|axis| axis + 3 * is_negative[axis]),
            far: [0, 1, 2].map(|axis| axis + 3 - 3 * is_negative[axis]),
            t_min: L::splat(ray.t_min / TOLERANCE),
            t_max: L::splat(ray.t_max * TOLERANCE),
            end: ray.t_max * TOLERANCE,
            // Two slots share an octant, hence the shift.
            flip: negative << 1 ^ (LANES as u32 - 1),
            flip_near_first: negative << 1,
        }
    }

    /// Shortens the ray to a nearer hit.
    #[inline(always)]
    pub fn shorten(&mut self, t_max: f32) {
        self.end = t_max * TOLERANCE;
        self.t_max = L::splat(self.end);
    }

    /// Where the ray enters and leaves each child; it misses those that it leaves before it enters.
    ///
    /// The slab test of Ize 2013, "Robust BVH Ray Traversal". 0 · ∞ is NaN if the ray runs within a plane of the box. It is
    /// the first operand of `max` and `min`, which then return the second: the interval stays as it is.
    #[inline(always)]
    fn interval(&self, node: &Node) -> (L, L) {
        let [x, y, z] = self.distances(node, self.near, self.origin_near);
        let enter = x.max(y.max(z.max(self.t_min)));
        let [x, y, z] = self.distances(node, self.far, self.origin_far);
        (enter, x.min(y.min(z.min(self.t_max))))
    }

    /// Where the ray meets one plane of each axis.
    #[inline(always)]
    fn distances(&self, node: &Node, planes: [usize; 3], o: [L; 3]) -> [L; 3] {
        let [x, y, z] = planes;
        [
            (L::load(&node.planes[x % 6]) - o[0]) * self.inverse[0],
            (L::load(&node.planes[y % 6]) - o[1]) * self.inverse[1],
            (L::load(&node.planes[z % 6]) - o[2]) * self.inverse[2],
        ]
    }

    /// The slots whose boxes the ray meets.
    #[inline(always)]
    pub fn slots_met(&self, node: &Node) -> Mask {
        let (enter, leave) = self.interval(node);
        enter.le(leave).bits()
    }

    /// The lanes whose boxes the ray meets, flipped by `flip`, so that far children come first; and where it enters each,
    /// for [`super::stack::Stack::push_children`].
    #[inline(always)]
    pub fn lanes_met(&self, node: &Node) -> (Mask, L) {
        let (enter, leave) = self.interval(node);
        let (enter, leave) = (enter.flip(self.flip), leave.flip(self.flip));
        (L::flip_mask(enter.le(leave), self.flip), enter)
    }
}
