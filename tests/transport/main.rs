//! Light transport: images whose truth is a formula, and estimators that have to agree.
//!
//! Statistics use the error that the film itself reports. Where a test was seen to catch a break of the code, its
//! comment says which.

#[path = "../scenes/mod.rs"]
mod scenes;
mod statistics;

mod closed_forms;
mod estimators;
mod film_error;
mod random_scenes;
mod scale;
mod slope;
