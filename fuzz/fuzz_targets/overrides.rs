//! Any text as an override of a small scene.
#![no_main]

#[path = "../checks/scenes.rs"]
#[allow(dead_code)]
mod checks;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| checks::overrides(text));
