//! What another crate brings, through the whole renderer: lobes, materials, textures and lights that are right, and
//! such that write something wrong where that must not cost light.

#[path = "../scenes/mod.rs"]
mod scenes;
#[path = "../transport/statistics.rs"]
mod statistics;

mod furnace;
mod lights;
mod places;
