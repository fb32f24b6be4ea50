//! Opening and reading ordinary files.

use std::fs::{self, File};
#[cfg(feature = "scene-file")]
use std::io::Read;
use std::io::{self, ErrorKind};
use std::path::Path;

/// Opens a file for reading.
///
/// # Errors
/// Those of the system, and if it is a folder (of [`ErrorKind::IsADirectory`]), a pipe, a socket or a device: opening or
/// reading these may wait forever, or never end.
pub fn open(path: &Path) -> io::Result<File> {
    // Before opening it, which waits for the writer of a pipe.
    let found = fs::metadata(path)?;
    if found.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    if !found.is_file() {
        return Err(io::Error::other(
            "it is a pipe, a socket or a device, expected an ordinary file",
        ));
    }
    File::open(path)
}

/// Reads a whole file of at most `most` MiB.
///
/// # Errors
/// Those of [`open`] and of reading, and if it is larger or there is not enough memory for it.
#[cfg(feature = "scene-file")]
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let limit = most << 20;
    let mut bytes = Vec::new();
    let file = open(path)?;
    // The size is a hint only: the file may be growing.
    let size = file.metadata()?.len().min(limit);
    bytes.try_reserve_exact(usize::try_from(size).unwrap_or(usize::MAX))?;
    file.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        return Err(io::Error::other(format!(
            "it is larger than {most} MiB, the most that is read"
        )));
    }
    Ok(bytes)
}
