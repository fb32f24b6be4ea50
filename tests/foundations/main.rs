//! Foundations: sampling, lobes, floats, rays and surface interactions.
//!
//! One program, so that its modules share `common` and link once; `cargo test sampling` and
//! `cargo test energy` select by the names of modules. Each test says in its comment which break of
//! the code it was seen to catch.

mod common;
#[path = "../scenes/mod.rs"]
mod scenes;

mod bxdf;
mod energy;
mod filters;
mod floats;
mod frames;
mod interaction;
mod lights;
mod materials;
mod optics;
mod rays;
mod sampling;
mod textures;
