//! Rays against all triangles of a scene: the tree that obvhs builds, and the way rays walk it.
//!
//! [`Accel`] answers one ray at a time or a batch; callers that can should use the batches, which find what
//! neighbouring rays have in common. Both use the widest instructions that the processor has, see [`Path`].

// For SIMD instructions in `lanes`, what they load in `triangles`, and the way to them in `path`.
#![allow(unsafe_code)]

mod aabb;
mod batch;
mod beam;
mod binary;
mod build;
mod bundle;
mod collapse;
mod edges;
mod frustum;
mod hit;
mod lanes;
mod layout;
mod needle;
mod node;
mod packet;
mod parallel;
mod part;
mod path;
mod slabs;
mod sort;
mod source;
mod split;
mod stack;
mod top;
mod triangles;
mod walk;

pub use aabb::Aabb;
pub use build::Accel;
pub use hit::Hit;
pub use path::Path;

use crate::geometry::Ray;
use stack::Stack;
use walk::{Found, Start};

impl Accel {
    /// The closest hit of each ray.
    ///
    /// # Panics
    /// If `hits` is not as long as `rays`.
    pub fn intersect(&self, rays: &[Ray], hits: &mut [Hit]) {
        assert_eq!(rays.len(), hits.len());
        Stack::with(|stack| self.answer_hits(stack, rays, hits));
    }

    /// Whether each ray hits anything.
    ///
    /// # Panics
    /// If `occluded` is not as long as `rays`.
    pub fn occluded(&self, rays: &[Ray], occluded: &mut [bool]) {
        assert_eq!(rays.len(), occluded.len());
        Stack::with(|stack| self.answer_occluded(stack, rays, occluded));
    }

    /// The closest hit of one ray. Of two at the same distance, the one of the first triangle counts.
    pub fn intersect1(&self, ray: &Ray) -> Hit {
        self.hit(Stack::with(|stack| self.closest_of_one(stack, ray, Start::ROOT)))
    }

    /// Whether one ray hits anything.
    pub fn occluded1(&self, ray: &Ray) -> bool {
        Stack::with(|stack| self.any_of_one(stack, ray, Start::ROOT))
    }

    /// A hit as the outside sees it.
    #[inline]
    fn hit(&self, found: Found) -> Hit {
        let Some((hit, number)) = found else { return Hit::MISS };
        let (shape, triangle) = self.triangle_of(number);
        Hit { t: hit.t, b: hit.b, shape, triangle }
    }

    /// The mesh of a triangle, and its number there.
    #[inline]
    fn triangle_of(&self, number: u32) -> (u32, u32) {
        let shape = match &self.shapes[..] {
            [_] => 0,
            shapes => shapes.partition_point(|&first| first <= number) - 1,
        };
        (shape as u32, number - self.shapes[shape])
    }
}
