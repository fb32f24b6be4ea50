//! Light transport: images compared with formulas, and unbiased estimators compared with each other.
//!
//! Statistics use the error that the film itself states. If a test was seen to catch a break of the code, its
//! comment says which.

#[path = "../scenes/mod.rs"]
mod scenes;
mod statistics;

mod closed_forms;
mod coverage;
mod dimensions;
mod environment;
mod estimators;
mod film_error;
mod many_lights;
mod random_scenes;
mod roulette;
mod scale;
mod slope;
