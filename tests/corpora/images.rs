//! Image files.

#[path = "../../fuzz/checks/images.rs"]
mod checks;

use crate::drive;

/// Seen to fail with blocks that lie outside the image: an index out of bounds.
#[test]
fn exr() {
    drive("exr", checks::exr);
}

/// Seen to fail with the decoder's messages as they are, which have several lines.
#[test]
fn jpeg() {
    drive("jpeg", checks::jpeg);
}

/// Seen to fail with sides of 0: a division of rows by zero.
#[test]
fn pfm() {
    drive("pfm", checks::pfm);
}

/// Seen to fail with grey and opacity taken for three colours: an index out of bounds.
#[test]
fn png() {
    drive("png", checks::png);
}
