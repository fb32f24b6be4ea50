//! Rays against all triangles of a scene: the tree that obvhs builds, and the way rays walk it.
//!
//! [`Accel`] answers one ray at a time or a batch; callers that can should use the batches, which is
//! where wider hardware is put to use without a change outside of this module.

mod aabb;
mod build;
mod bundle;
mod leaf;
mod walk;

pub use aabb::Aabb;
pub use build::Accel;
pub use walk::Hit;
