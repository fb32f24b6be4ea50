//! Any bytes as a line of `runs.csv`: see `checks/runs.rs`.
#![no_main]

#[path = "../checks/runs.rs"]
mod runs;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| runs::run(bytes));
