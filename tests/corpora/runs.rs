//! Lines of `runs.csv`.

#[path = "../../fuzz/checks/runs.rs"]
mod checks;

use crate::drive;

/// Seen to fail with names whose quotes are not doubled, and with numbers that are not finite.
#[test]
fn runs() {
    drive("runs", checks::run);
}
