//! Rays against triangles, through the real tree.
//!
//! Everything here asks the public functions alone, one ray at a time and in batches, so that it holds
//! whatever the tree is inside. What stands on the surface of floats is asked bit by bit. The tests that
//! are ignored are the same at larger sizes: `cargo test --release rays -- --ignored`.

mod answers;
mod batches;
mod brute_force;
mod degenerate;
mod edges;
mod kinds;
mod limits;
mod needles;
mod neighbours;
mod no_rays;
mod places;
mod self_hit;
mod watertight;
