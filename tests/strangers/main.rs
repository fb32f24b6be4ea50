//! Lobes, materials, textures and lights of another crate, through the whole renderer. Some are correct, some report
//! something wrong that must not cost light.

#[path = "../scenes/mod.rs"]
mod scenes;
#[path = "../transport/statistics.rs"]
mod statistics;

mod albedo;
mod furnace;
mod lights;
mod places;
