//! Any text as a scene file, which is rendered if it is one.
#![no_main]

#[path = "../checks/scenes.rs"]
#[allow(dead_code)]
mod checks;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| checks::scene(text));
