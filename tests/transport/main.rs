//! Light transport: images whose truth is a formula, and estimators that have to agree.
//!
//! Statistics use the error that the film itself reports. Each test says in its comment which break of the
//! code it was seen to catch.

#[path = "../scenes/mod.rs"]
mod scenes;
mod statistics;

mod closed_forms;
mod estimators;
mod film_error;
mod random_scenes;
mod scale;
mod slope;
