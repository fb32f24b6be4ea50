//! The files in `assets` are what the sculptor makes.

use std::path::Path;

use sculpt_dragon::{Subject, sculpt, write_obj};

/// Sculpts `subject` on three threads and compares its bytes with the file.
fn check(subject: Subject, triangles: usize, name: &str) {
    let sculpted = sculpt(subject, triangles, 3).unwrap_or_else(|fault| panic!("{fault}"));
    let mut bytes = Vec::new();
    let (mesh, uv) = (&sculpted.mesh, subject.uv(&sculpted.mesh));
    write_obj(&mut bytes, subject.title(), mesh, &sculpted.normals, uv.as_ref()).unwrap();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(name);
    assert!(std::fs::read(&path).unwrap() == bytes, "{name} is not what the sculptor makes");
}

/// Seen to fail with twice the `stay` of the dragon.
#[test]
fn dragon() {
    check(Subject::Dragon, 100_000, "dragon.obj");
}

/// Seen to fail with twice the `stay` of the object.
#[test]
fn object() {
    check(Subject::Object, 22_000, "object.obj");
}
