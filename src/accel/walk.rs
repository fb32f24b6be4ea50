//! How rays walk the tree.

use glam::Vec3;

use super::Accel;
use super::build::{Child, Node};
use super::leaf::LeafTriangle;
use crate::geometry::Ray;
use crate::geometry::float::gamma;
use crate::shape::ShearedRay;

/// Where a ray meets a triangle first. Everything else about the hit is found from it on demand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance in lengths of the ray's direction; infinite for a ray that hits nothing.
    pub t: f32,
    /// Barycentric weights of the triangle's corners.
    pub b: [f32; 3],
    /// Which mesh of those that the tree was built from.
    pub shape: u32,
    /// Which triangle of that mesh.
    pub triangle: u32,
}

impl Hit {
    /// What a ray gets that hits nothing.
    pub const MISS: Self =
        Self { t: f32::INFINITY, b: [0.0; 3], shape: u32::MAX, triangle: u32::MAX };

    /// Whether the ray hit something.
    #[inline]
    pub fn is_hit(&self) -> bool {
        self.shape != u32::MAX
    }
}

/// Trees up to this depth are walked with a stack in place; deeper ones, which only degenerate scenes
/// have, with one on the heap that serves a whole batch.
const STACK: usize = 64;

/// A child that waits, and where the ray enters its box.
type Waiting = (Child, f32);

impl Accel {
    /// The closest hit of each ray.
    ///
    /// # Panics
    /// If `hits` is not as long as `rays`.
    pub fn intersect(&self, rays: &[Ray], hits: &mut [Hit]) {
        assert_eq!(rays.len(), hits.len());
        self.with_stack(|stack| {
            for (ray, hit) in rays.iter().zip(hits) {
                *hit = self.closest(stack, ray);
            }
        });
    }

    /// Whether each ray hits anything.
    ///
    /// # Panics
    /// If `occluded` is not as long as `rays`.
    pub fn occluded(&self, rays: &[Ray], occluded: &mut [bool]) {
        assert_eq!(rays.len(), occluded.len());
        self.with_stack(|stack| {
            for (ray, occluded) in rays.iter().zip(occluded) {
                *occluded = self.any(stack, ray);
            }
        });
    }

    /// The closest hit of one ray. Of two at the same distance, the one of the first triangle counts.
    pub fn intersect1(&self, ray: &Ray) -> Hit {
        self.with_stack(|stack| self.closest(stack, ray))
    }

    /// Whether one ray hits anything.
    pub fn occluded1(&self, ray: &Ray) -> bool {
        self.with_stack(|stack| self.any(stack, ray))
    }

    fn closest(&self, stack: &mut [Waiting], ray: &Ray) -> Hit {
        let sheared = ShearedRay::new(ray);
        let mut closest = Hit::MISS;
        self.walk(stack, ray, |leaf, t_max| {
            for triangle in leaf {
                let Some(found) = sheared.intersect(&triangle.corners, ray.t_min, *t_max) else {
                    continue;
                };
                let number = (triangle.shape, triangle.triangle);
                if found.t < *t_max
                    || !closest.is_hit()
                    || number < (closest.shape, closest.triangle)
                {
                    *t_max = found.t;
                    closest = Hit { t: found.t, b: found.b, shape: number.0, triangle: number.1 };
                }
            }
            false
        });
        closest
    }

    fn any(&self, stack: &mut [Waiting], ray: &Ray) -> bool {
        let sheared = ShearedRay::new(ray);
        let mut found = false;
        self.walk(stack, ray, |leaf, t_max| {
            found = leaf.iter().any(|t| sheared.intersect(&t.corners, ray.t_min, *t_max).is_some());
            found
        });
        found
    }

    /// Calls `act` with room for as many waiting children as the tree is deep.
    #[inline]
    fn with_stack<R>(&self, act: impl FnOnce(&mut [Waiting]) -> R) -> R {
        const NONE: Waiting = (Child { first: 0, count: 0 }, 0.0);
        if self.depth <= STACK { act(&mut [NONE; STACK]) } else { act(&mut vec![NONE; self.depth]) }
    }

    /// Visits the leaves that the ray may meet, near ones first, until `visit` returns true. `visit`
    /// may shorten the ray.
    #[inline]
    fn walk(
        &self,
        stack: &mut [Waiting],
        ray: &Ray,
        mut visit: impl FnMut(&[LeafTriangle], &mut f32) -> bool,
    ) {
        let Some(mut node) = self.nodes.first() else { return };
        let slabs = Slabs::new(ray, self.bounds.largest_coordinate());
        let mut t_max = ray.t_max;
        let mut waiting = 0;
        loop {
            let [mut near, mut far] =
                [0, 1].map(|side| (node.children[side], slabs.enter(node, side, t_max)));
            if far.1 < near.1 {
                (near, far) = (far, near);
            }
            // A box that is missed is infinitely far away.
            if far.1 < f32::INFINITY {
                stack[waiting] = far;
                waiting += 1;
            }
            let mut next = near;
            node = loop {
                if next.1 <= t_max && next.1 < f32::INFINITY {
                    if next.0.count == 0 {
                        break &self.nodes[next.0.first as usize];
                    }
                    let first = next.0.first as usize;
                    if visit(&self.leaves[first..first + next.0.count as usize], &mut t_max) {
                        return;
                    }
                }
                if waiting == 0 {
                    return;
                }
                waiting -= 1;
                next = stack[waiting];
            };
        }
    }
}

/// A ray prepared for boxes.
///
/// A ray may meet a triangle, as the triangle test rounds, where it just misses the triangle's box.
/// So every box is taken to be larger by a bound on that error, and hits are never lost. The bound
/// is moved into the origin, once for the planes where rays enter and once for those where they leave.
struct Slabs {
    origin_in: Vec3,
    origin_out: Vec3,
    inverse: Vec3,
    /// Which axes the ray runs along backwards; told from the sign bit, so that -0 counts.
    backwards: [bool; 3],
    t_min: f32,
}

impl Slabs {
    #[inline]
    fn new(ray: &Ray, largest_coordinate: f32) -> Self {
        // Moving the corners to the ray's origin and shearing them costs up to four roundings of
        // numbers no larger than the distance from the origin to the corner.
        let reach = largest_coordinate + ray.o.abs().max_element();
        let padding = Vec3::splat(4.0 * f32::EPSILON * reach).copysign(ray.d);
        Self {
            origin_in: ray.o + padding,
            origin_out: ray.o - padding,
            inverse: ray.d.recip(),
            backwards: ray.d.to_array().map(f32::is_sign_negative),
            t_min: ray.t_min,
        }
    }

    /// Where the ray enters a child's box, or infinity if it misses it before `t_max`.
    ///
    /// The slab test of Ize 2013, "Robust BVH Ray Traversal": comparisons are written such that NaN,
    /// from 0 · ∞ when the ray runs within a plane of the box, leaves the interval as it is.
    #[inline]
    fn enter(&self, node: &Node, side: usize, t_max: f32) -> f32 {
        let (mut enter, mut leave) = (self.t_min, t_max);
        let (min, max) = (node.min[side], node.max[side]);
        for axis in 0..3 {
            let (plane_in, plane_out) =
                if self.backwards[axis] { (max[axis], min[axis]) } else { (min[axis], max[axis]) };
            let t_in = (plane_in - self.origin_in[axis]) * self.inverse[axis];
            let t_out = (plane_out - self.origin_out[axis]) * self.inverse[axis];
            enter = if t_in > enter { t_in } else { enter };
            leave = if t_out < leave { t_out } else { leave };
        }
        if enter <= leave * (1.0 + 2.0 * gamma(3)) { enter } else { f32::INFINITY }
    }
}
