//! How rays are traced through the tree.
//!
//! [`single_ray`] walks the tree with one ray, [`beam`] with up to 64 rays that share a frustum, and [`batch`] chooses
//! between both for a slice of rays. A node's boxes are tested by [`slabs`] (one ray) or [`frustum`] (a beam), a leaf's
//! triangles by [`leaf_test`] (one ray, all triangles) or [`packet`] (sixteen rays, one triangle), with the formulas of
//! `shape/watertight.rs`. Children still to be visited wait on a [`stack`]. All of it is generic over the vectors of
//! `simd/`, and reads the data of `tree/`. It never knows `build/`.

mod batch;
mod beam;
mod forest;
mod frustum;
mod leaf_test;
mod packet;
mod single_ray;
mod slabs;
mod space;
mod stack;

pub use batch::Batch;
pub use forest::InForest;
pub use single_ray::{AnyHit, ClosestHit, Start};
pub use space::World;
pub use stack::Stack;
