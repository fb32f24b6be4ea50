//! The checks of the fuzz targets, on stable Rust: every file of a corpus in `fuzz/corpus`, and a fixed number of changed
//! copies of each.

mod images;
mod mutate;
mod runs;
mod scenes;

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use mutate::{Random, mutate};

/// Changed copies of each file.
const TRIALS: u64 = 60;

/// Checks all files of a corpus and their changed copies. What fails is named by file and trial: a test that is to look at
/// one again calls `mutate` with `Random::new(file, trial)`.
fn drive(corpus: &str, check: impl Fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(corpus);
    let entries = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{folder:?}: {error}"));
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let files: Vec<Vec<u8>> = paths.iter().map(|path| fs::read(path).unwrap()).collect();
    assert!(!files.is_empty(), "{folder:?} is empty");
    for (file, (path, bytes)) in paths.iter().zip(&files).enumerate() {
        run(&check, bytes, || format!("{path:?}"));
        for trial in 0..TRIALS {
            let changed = mutate(bytes, &files, &mut Random::new(file as u64, trial));
            run(&check, &changed, || format!("{path:?}, the file of index {file}, trial {trial}"));
        }
    }
}

#[track_caller]
fn run(check: impl Fn(&[u8]), bytes: &[u8], name: impl Fn() -> String) {
    if catch_unwind(AssertUnwindSafe(|| check(bytes))).is_err() {
        panic!("{}", name());
    }
}
