//! [`Slabs`]: a ray against the boxes of a node.

use glam::Vec3A;

use super::lanes::{LANES, Lanes, Mask, splat3};
use super::node::Node;
use crate::geometry::Ray;
use crate::geometry::float::gamma;

/// A ray prepared for boxes.
///
/// A ray may meet a triangle, as the triangle test rounds, where it just misses the triangle's box.
/// So every box is taken to be larger by a bound on that error, and hits are never lost. The bound
/// is moved into the origin, once for the planes where rays enter and once for those where they leave.
pub struct Slabs<L> {
    origin_in: [L; 3],
    origin_out: [L; 3],
    inverse_in: [L; 3],
    inverse_out: [L; 3],
    /// Which planes are met first, and last.
    first: [usize; 3],
    last: [usize; 3],
    t_min: L,
    t_max: L,
    /// `t_max` of every lane: beyond it a box need not be entered.
    pub end: f32,
    /// Turns slots into the order in which the ray meets them, the last one first.
    pub flip: u32,
    /// The same, the first one first.
    pub backwards: u32,
}

/// By how much t may be too large where a ray leaves a box.
const TOLERANCE: f32 = 1.0 + 2.0 * gamma(3);

impl<L: Lanes> Slabs<L> {
    #[inline(always)]
    pub fn new(ray: &Ray, largest_coordinate: f32) -> Self {
        // Moving the corners to the ray's origin and shearing them costs up to four roundings of
        // numbers no larger than the distance from the origin to the corner.
        let reach = largest_coordinate + ray.o.abs().max_element();
        let padding = Vec3A::splat(4.0 * f32::EPSILON * reach).copysign(ray.d.into());
        let o = Vec3A::from(ray.o);
        let inverse = Vec3A::ONE / Vec3A::from(ray.d);
        // Told from the sign bit, so that -0 counts.
        let backwards = Vec3A::from(ray.d).is_negative_bitmask();
        let is_backwards = [0, 1, 2].map(|axis| backwards as usize >> axis & 1);
        Self {
            origin_in: splat3((o + padding).to_array()),
            origin_out: splat3((o - padding).to_array()),
            inverse_in: splat3(inverse.to_array()),
            inverse_out: splat3((inverse * TOLERANCE).to_array()),
            first: [0, 1, 2].map(|axis| axis + 3 * is_backwards[axis]),
            last: [0, 1, 2].map(|axis| axis + 3 - 3 * is_backwards[axis]),
            t_min: L::splat(ray.t_min),
            t_max: L::splat(ray.t_max * TOLERANCE),
            end: ray.t_max * TOLERANCE,
            // Two slots to an octant.
            flip: backwards << 1 ^ (LANES as u32 - 1),
            backwards: backwards << 1,
        }
    }

    /// Forgets what lies beyond `t_max`.
    #[inline(always)]
    pub fn shorten(&mut self, t_max: f32) {
        self.end = t_max * TOLERANCE;
        self.t_max = L::splat(self.end);
    }

    /// Where the ray enters and leaves each child; it misses those that it leaves before it enters.
    ///
    /// The slab test of Ize 2013, "Robust BVH Ray Traversal": NaN, from 0 · ∞ when the ray runs within a
    /// plane of the box, comes first into `max` and `min`, which leave the interval as it is then.
    #[inline(always)]
    fn interval(&self, node: &Node) -> (L, L) {
        let enter = |axis: usize| {
            let plane = L::load(&node.planes[self.first[axis] % 6]);
            plane.sub(self.origin_in[axis]).mul(self.inverse_in[axis])
        };
        let leave = |axis: usize| {
            let plane = L::load(&node.planes[self.last[axis] % 6]);
            plane.sub(self.origin_out[axis]).mul(self.inverse_out[axis])
        };
        (
            enter(0).max(enter(1).max(enter(2).max(self.t_min))),
            leave(0).min(leave(1).min(leave(2).min(self.t_max))),
        )
    }

    /// Which slots the ray meets.
    #[inline(always)]
    pub fn meets(&self, node: &Node) -> Mask {
        let (enter, leave) = self.interval(node);
        enter.le(leave)
    }

    /// Which children the ray meets, in lanes flipped by `flip`, far ones first; and where it enters them, as
    /// [`Lanes::push`] takes it.
    #[inline(always)]
    pub fn enters(&self, node: &Node) -> (Mask, L) {
        let (enter, leave) = self.interval(node);
        let (enter, leave) = (enter.turned(self.flip), leave.turned(self.flip));
        (L::turned_mask(enter.le(leave), self.flip), enter)
    }
}
