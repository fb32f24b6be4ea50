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
    let telling = b"\n\r\\#/ -+.0123456789efvntaginINF\t\xE9\xEF\xBB\xBF\xFF\x00";
    drive("obj", 1500, telling, checks::obj);
}

// Broken by: names shown as they are.
#[test]
fn scene_files() {
    drive("scene", 400, b"\n[]{}=\"'.,#-+0123456789einfa_ \\\x1b\xE2\x80\xAE", |bytes| {
        checks::scene(&text(bytes));
    });
}

// Broken by: overrides shown as they are.
#[test]
fn overrides() {
    drive("overrides", 300, b"\n[]{}=\"'.,#-+0123456789einfa_ \\\x1b\xE2\x80\xAE", |bytes| {
        checks::overrides(&text(bytes));
    });
}

// Broken by: of equally near triangles the last one taken.
#[test]
fn rays_through_any_triangles() {
    drive("accel", 400, b"\x00\x01\x7F\x80\xFF\x3F\x7E", rays::accel);
}
