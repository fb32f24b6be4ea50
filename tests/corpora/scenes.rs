//! OBJ files, scene files, overrides, and rays through any triangles.
//!
//! The comment of a test says with which deliberate break of the code it was seen to fail.

#[path = "../../fuzz/checks/scenes.rs"]
mod checks;
#[path = "../../fuzz/checks/rays.rs"]
mod rays;

use super::drive;

/// Text is what UTF-8 there is: a scene file that is not UTF-8 is refused before it is parsed.
fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

// Broken by: an index beyond the last element let pass at the end of a file.
#[test]
fn obj_files() {
    drive("obj", checks::obj);
}

// Broken by: names shown as they are.
#[test]
fn scene_files() {
    drive("scene", |bytes| {
        checks::scene(&text(bytes));
    });
}

// Broken by: overrides shown as they are.
#[test]
fn overrides() {
    drive("overrides", |bytes| {
        checks::overrides(&text(bytes));
    });
}

// Broken by: of equally near triangles the last one taken.
#[test]
fn rays_through_any_triangles() {
    drive("accel", rays::accel);
}
