//! A folder for the files of tests that no other run of the tests uses, so that two can share a target folder.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The folder of this process, which exists and is empty at first. It is removed by a later run. A lock on a file beside it tells
/// those runs that this one is alive.
pub fn of_this_run() -> &'static Path {
    static RUN: OnceLock<(PathBuf, File)> = OnceLock::new();
    &RUN.get_or_init(|| {
        let all = Path::new(env!("CARGO_TARGET_TMPDIR")).join("runs");
        fs::create_dir_all(&all).unwrap();
        // One process at a time removes and creates.
        let door = File::create(all.join("lock")).unwrap();
        door.lock().unwrap();
        remove_dead_runs(&all);
        let name = |number: u32| all.join(format!("{}-{number}", std::process::id()));
        let folder = (0..).map(name).find(|folder| !folder.exists()).unwrap();
        let lock = File::create(folder.with_extension("lock")).unwrap();
        lock.lock().unwrap();
        fs::create_dir(&folder).unwrap();
        (folder, lock)
    })
    .0
}

fn remove_dead_runs(all: &Path) {
    for entry in fs::read_dir(all).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "lock") || !path.is_file() {
            continue;
        }
        if File::open(&path).unwrap().try_lock().is_ok() {
            // A folder in which a test has taken away its right to write stays.
            if fs::remove_dir_all(path.with_extension("")).is_ok() {
                let _ = fs::remove_file(&path);
            }
        }
    }
}
