//! [`Folder`]: a folder with a chart's files, to which one process at a time writes.

use std::error::Error;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use lobe::image::{is_temporary, sweep_temporaries, write_file};
use lobe::params::Shown;

/// The file that a chart locks while it runs. The system ends the lock with the process, however that ends.
const LOCK: &str = ".lobe-chart.lock";

/// A chart's folder, locked against other charts.
pub struct Folder {
    path: PathBuf,
    _lock: File,
}

impl Folder {
    /// Opens the folder of a chart, or a new or empty one, which is created if it does not exist. A chart's folder has a file
    /// `marker`, which `check` accepts. Removes temporary files of killed processes.
    pub fn open(
        path: &Path,
        marker: &str,
        check: impl FnOnce(&Path) -> Result<(), Box<dyn Error>>,
    ) -> Result<Self, Box<dyn Error>> {
        let shown = Shown::path(path);
        if path.is_file() {
            return Err(format!("`{shown}` is a file: choose a folder with -o").into());
        }
        fs::create_dir_all(path)
            .map_err(|error| format!("cannot create the folder `{shown}`: {error}"))?;
        sweep_temporaries(path);
        let marked = path.join(marker);
        let unreadable = |error| format!("cannot read the folder `{shown}`: {error}");
        if fs::symlink_metadata(&marked).is_ok() {
            check(&marked)?;
        } else if let Some(name) = anything_in(path).map_err(unreadable)? {
            return Err(format!(
                "`{shown}` is not the folder of such a chart: it has `{name}`, but no `{marker}`; choose a new or empty \
                 folder with -o"
            )
            .into());
        }
        let lock = lock(path)?;
        sweep_temporaries(&path.join("means"));
        Ok(Self { path: path.to_owned(), _lock: lock })
    }

    pub fn join(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a file whole or not at all.
    pub fn write(&self, name: &str, contents: &[u8]) -> Result<(), Box<dyn Error>> {
        Ok(write_file(self.join(name), contents)?)
    }

    /// Removes a file, if it is there.
    pub fn remove(&self, name: &str) -> Result<(), Box<dyn Error>> {
        let path = self.join(name);
        match fs::remove_file(&path) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                Err(format!("cannot remove `{}`: {error}", Shown::path(&path)).into())
            }
            _ => Ok(()),
        }
    }
}

/// Checks that this is an ordinary file of at most so many bytes, before it is read.
pub fn check_size(path: &Path, most: u64) -> Result<(), Box<dyn Error>> {
    let shown = Shown::path(path);
    match fs::metadata(path) {
        Ok(found) if !found.is_file() => Err(format!("`{shown}` is not an ordinary file").into()),
        Ok(found) if found.len() > most => {
            Err(format!("`{shown}` has {} bytes, expected at most {most}", found.len()).into())
        }
        Ok(_) => Ok(()),
        Err(error) => Err(format!("cannot read `{shown}`: {error}").into()),
    }
}

/// The first name in a folder, apart from what a killed chart leaves in an empty one.
fn anything_in(folder: &Path) -> io::Result<Option<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder)? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        if name != LOCK && !is_temporary(&name) {
            names.push(name);
        }
    }
    Ok(names.into_iter().min())
}

fn lock(folder: &Path) -> Result<File, Box<dyn Error>> {
    let path = folder.join(LOCK);
    // Opened for reading, too: that does not wait for the other end of a pipe.
    let options =
        OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path);
    let file = options.map_err(|error| {
        format!(
            "cannot write to the folder `{}`: {error}; choose another one with -o",
            Shown::path(folder)
        )
    })?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(format!(
            "another `lobe chart` is writing to `{}`: wait until it ends, or choose another folder with -o",
            Shown::path(folder)
        )
        .into()),
        Err(TryLockError::Error(error)) => {
            Err(format!("cannot lock `{}`: {error}; choose a folder on another disk with -o", Shown::path(&path)).into())
        }
    }
}
