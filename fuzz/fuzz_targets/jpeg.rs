//! Any bytes as a JPEG file: see `checks/images.rs`.
#![no_main]

#[allow(dead_code)]
#[path = "../checks/images.rs"]
mod images;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| images::jpeg(bytes));
