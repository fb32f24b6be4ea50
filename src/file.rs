//! Opening and reading ordinary files, and finding those that other programs name.

use std::ffi::OsString;
use std::fs::{self, File};
#[cfg(feature = "scene-file")]
use std::io::Read;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

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

/// The file that another program means by `name`, relative to `folder`: with slashes of either kind, in whatever case; else the
/// one in `folder` itself with the last part of the name, as paths of other computers lead nowhere.
pub fn find(folder: &Path, name: &str) -> Option<PathBuf> {
    let slashed = name.replace('\\', "/");
    let last = slashed.rsplit('/').next().unwrap_or_default();
    let exact = [name, &slashed].map(|name| folder.join(name));
    let exact = exact.into_iter().find(|path| path.is_file());
    exact.or_else(|| in_any_case(folder, &slashed)).or_else(|| in_any_case(folder, last))
}

/// The first file, in the order of names, whose path below `folder` is `name` but for the case of letters.
fn in_any_case(folder: &Path, name: &str) -> Option<PathBuf> {
    let mut path = folder.to_owned();
    for part in name.split('/').filter(|part| !matches!(*part, "" | ".")) {
        let exact = path.join(part);
        if exact.exists() {
            path = exact;
            continue;
        }
        let part = part.to_lowercase();
        let is_meant = |found: &OsString| decoded(found.as_encoded_bytes()).to_lowercase() == part;
        let here = if path.as_os_str().is_empty() { Path::new(".") } else { &path };
        let names = fs::read_dir(here).ok()?.flatten().map(|entry| entry.file_name());
        let found = names.filter(is_meant).min()?;
        path.push(found);
    }
    path.is_file().then_some(path)
}

/// Bytes of unknown encoding as text: UTF-8, else Latin-1.
pub fn decoded(bytes: &[u8]) -> String {
    match str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
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
