//! Rays against all triangles of a scene: the tree that obvhs builds, and the way rays walk it.
//!
//! [`Accel`] answers one ray at a time or a batch; callers that can should use the batches, which find what
//! neighbouring rays have in common. Both use the widest instructions that the processor has, see [`Path`].

// For the instructions of AVX-512 in `lanes`, and the way to them in `path`.
#![allow(unsafe_code)]

mod aabb;
mod binary;
mod build;
mod bundle;
mod collapse;
mod hit;
mod lanes;
mod layout;
mod needle;
mod node;
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

impl Accel {
    /// The closest hit of each ray.
    ///
    /// # Panics
    /// If `hits` is not as long as `rays`.
    pub fn intersect(&self, rays: &[Ray], hits: &mut [Hit]) {
        assert_eq!(rays.len(), hits.len());
        Stack::with(|stack| self.closest_of_each(stack, rays, hits));
    }

    /// Whether each ray hits anything.
    ///
    /// # Panics
    /// If `occluded` is not as long as `rays`.
    pub fn occluded(&self, rays: &[Ray], occluded: &mut [bool]) {
        assert_eq!(rays.len(), occluded.len());
        Stack::with(|stack| self.any_of_each(stack, rays, occluded));
    }

    /// The closest hit of one ray. Of two at the same distance, the one of the first triangle counts.
    pub fn intersect1(&self, ray: &Ray) -> Hit {
        Stack::with(|stack| self.closest_of_one(stack, ray))
    }

    /// Whether one ray hits anything.
    pub fn occluded1(&self, ray: &Ray) -> bool {
        Stack::with(|stack| self.any_of_one(stack, ray))
    }
}
