//! Building the tree, with obvhs for the binary trees that it is made of.
//!
//! [`build`] is the way through: [`partition`] sorts the triangles into parts, a [`treelet`] is built over each part,
//! [`top_level`] puts one tree above all treelets. A treelet is a binary tree ([`binary_tree`]) of primitives
//! ([`duplicates`]), for which [`collapse`] chooses the eight-wide nodes and [`layout`] writes them. Knows `simd/` (the
//! number of lanes alone) and `tree/`, never `trace/`.

mod assemble;
mod binary_tree;
mod collapse;
mod cuts;
mod duplicates;
mod forest;
mod layout;
mod parallel;
mod partition;
mod primitives;
mod top_level;
mod treelet;

pub use assemble::build;
pub use forest::build_forest;
pub use parallel::available_threads;
