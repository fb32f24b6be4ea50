//! Any bytes as triangles and rays.
#![no_main]

#[path = "../checks/rays.rs"]
#[allow(dead_code)]
mod checks;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| checks::accel(bytes));
