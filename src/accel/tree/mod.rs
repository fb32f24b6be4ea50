//! The tree that rays are traced through: a bounding volume hierarchy with eight children per node.
//!
//! Holds the data alone: nodes, leaves and what is known of them as a whole. Knows the vectors of `simd/`, which leaves
//! are laid out for, and neither how trees are built (`build/`) nor how rays walk them (`trace/`).

mod aabb;
mod bvh;
mod forest;
mod leaf;
mod leaves;
mod node;
mod triangle;

pub use aabb::Aabb;
pub use bvh::{Bvh, MAX_DEPTH};
pub use forest::{Forest, Place};
pub use leaf::Leaf;
pub use leaves::Leaves;
pub use node::{Child, MAX_TRIANGLES, Node};
pub use triangle::Triangle;
