//! Image files.

#[path = "../../fuzz/checks/images.rs"]
mod checks;

use crate::drive;

/// Seen to fail with a header's sizes believed.
#[test]
fn exr() {
    drive("exr", checks::exr);
}

/// Seen to fail with ...
#[test]
fn pfm() {
    drive("pfm", checks::pfm);
}

#[test]
fn png() {
    drive("png", checks::png);
}
