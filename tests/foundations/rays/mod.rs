//! Rays against triangles, through the real tree.
//!
//! These tests use only public functions, one ray at a time and in batches, so that they do not depend
//! on the tree's layout. Results that should be exact are compared bit by bit. The tests that
//! are ignored are the same at larger sizes: `cargo test --release rays -- --ignored`.

mod answers;
mod batches;
mod brute_force;
mod coincident;
mod degenerate;
mod edges;
mod instances;
mod instruction_sets;
mod invalid_rays;
mod kinds;
mod limits;
mod needles;
mod neighbours;
mod self_hit;
mod watertight;
