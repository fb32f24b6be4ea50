//! Rays against triangles, through the real tree.

mod brute_force;
mod degenerate;
mod self_hit;
mod watertight;
