//! Any bytes as an OBJ file: an error, or a mesh that keeps its promises.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(read) = lobe::shape::parse_obj("fuzz.obj", bytes) {
        read.mesh.check().expect("what is read is sound");
        assert!(!read.mesh.indices.is_empty());
    }
});
