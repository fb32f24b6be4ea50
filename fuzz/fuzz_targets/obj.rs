//! Any bytes as an OBJ file.
#![no_main]

#[path = "../checks/scenes.rs"]
#[allow(dead_code)]
mod checks;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| checks::obj(bytes));
