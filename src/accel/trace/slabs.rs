//! [`Slabs`]: one ray against the boxes of a node.

use glam::Vec3A;

use crate::accel::tree::Node;
use crate::geometry::Ray;
use crate::simd::{Eight, splat3};

/// A ray prepared for boxes.
///
/// The triangle test and the distances to planes are rounded, so a ray may hit a triangle whose box it just misses.
/// Therefore every box is padded by a bound on both errors, and no hit is lost. The padding is added to the
/// ray's origin: once for the planes where it enters boxes, once for those where it leaves.
pub struct Slabs<B> {
    inverse: [B; 3],
    /// What is added to the product of a plane and `inverse`, to give t where the ray enters and leaves.
    near: [B; 3],
    far: [B; 3],
    /// Index of the planes where the ray enters and leaves, on each axis.
    near_planes: [usize; 3],
    far_planes: [usize; 3],
    t_min: B,
    t_max: B,
    /// `t_max` of every lane: boxes that are entered later are skipped.
    pub end: f32,
}

/// Factor by which a ray's range is enlarged at both ends, for the rounding of the t that the triangle test tells: twice
/// [`crate::shape::T_TOLERANCE`].
const TOLERANCE: f32 = 1.0 + 2.0 * crate::shape::T_TOLERANCE;

/// A direction is taken to be at least so long along each axis, in lengths of its longest coordinate.
const LEAST: f32 = 1.0 / (1 << 26) as f32;

/// The padding of boxes in whose space rays and triangles are tested.
#[inline(always)]
pub fn padding(ray: &Ray, largest_coordinate: f32) -> f32 {
    // In units of half an epsilon, for numbers up to `reach`: a corner that is moved to the ray's origin and sheared is
    // off by up to 6 (two differences, quotient, product, sum); a plane by up to 5 (padded origin, inverse, two products,
    // sum), and by half of one, where the direction is taken to be `LEAST`. 6 epsilon in all, and a sixth for products of errors.
    let reach = largest_coordinate + ray.o.abs().max_element();
    7.0 * f32::EPSILON * reach
}

impl<B: Eight> Slabs<B> {
    #[inline(always)]
    pub fn new(ray: &Ray, largest_coordinate: f32) -> Self {
        Self::padded(ray, largest_coordinate, Vec3A::splat(padding(ray, largest_coordinate)))
    }

    /// With this padding of boxes along each axis.
    #[inline(always)]
    pub fn padded(ray: &Ray, largest_coordinate: f32, padding: Vec3A) -> Self {
        let (o, d) = (Vec3A::from(ray.o), Vec3A::from(ray.d));
        let padding = padding.copysign(d);
        let length = d.abs();
        let mut inverse =
            Vec3A::ONE / length.max(Vec3A::splat(LEAST * length.max_element())).copysign(d);
        let (mut near, mut far) = (-(o + padding) * inverse, -(o - padding) * inverse);
        // Where products might not be finite, the ray enters all boxes.
        let largest = Vec3A::splat(largest_coordinate) * inverse.abs() + near.abs().max(far.abs());
        let is_finite = largest.max_element() < 0.5 * f32::MAX;
        if !is_finite {
            inverse = Vec3A::ZERO;
            (near, far) = (Vec3A::NEG_INFINITY, Vec3A::INFINITY);
        }
        // By the sign bit, so that -0 counts as negative.
        let negative = d.is_negative_bitmask();
        let is_negative = [0, 1, 2].map(|axis| negative as usize >> axis & 1);
        let end = ray.t_max * TOLERANCE;
        Self {
            inverse: splat3(inverse.to_array()),
            near: splat3(near.to_array()),
            far: splat3(far.to_array()),
            near_planes: [0, 1, 2].map(|axis| axis + 3 * is_negative[axis]),
            far_planes: [0, 1, 2].map(|axis| axis + 3 - 3 * is_negative[axis]),
            t_min: B::splat((ray.t_min / TOLERANCE).max(f32::MIN)),
            t_max: B::splat(end),
            end,
        }
    }

    /// Shortens the ray to a nearer hit.
    #[inline(always)]
    pub fn shorten(&mut self, t_max: f32) {
        self.end = t_max * TOLERANCE;
        self.t_max = B::splat(self.end);
    }

    /// The children whose boxes the ray meets, and where it enters each: the slab test of Ize 2013, "Robust BVH Ray Traversal".
    #[inline(always)]
    pub fn met(&self, node: &Node) -> (B::Mask, B) {
        let [x, y, z] = self.distances(node, self.near_planes, self.near);
        let enter = x.max(y.max(z.max(self.t_min)));
        let [x, y, z] = self.distances(node, self.far_planes, self.far);
        let leave = x.min(y.min(z.min(self.t_max)));
        (enter.le(leave), enter)
    }

    /// Where the ray meets one plane of each axis.
    #[inline(always)]
    fn distances(&self, node: &Node, planes: [usize; 3], summands: [B; 3]) -> [B; 3] {
        let [x, y, z] = planes;
        [
            B::load(&node.planes[x % 6]).mul_add(self.inverse[0], summands[0]),
            B::load(&node.planes[y % 6]).mul_add(self.inverse[1], summands[1]),
            B::load(&node.planes[z % 6]).mul_add(self.inverse[2], summands[2]),
        ]
    }
}
