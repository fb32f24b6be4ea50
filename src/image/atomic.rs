//! Writing files whole or not at all.

use std::fs::{self, File, Permissions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use super::WriteError;

/// Checks that a file can be written to `path`, before time is spent on rendering it.
///
/// Creates an empty file with a temporary name in the same folder and removes it again. An existing file at `path` is
/// not touched. Whether there will be enough space is not checked.
///
/// # Errors
/// The error that [`write_file`] would return for this path.
///
/// ```
/// # let missing = std::env::temp_dir().join("lobe no such folder").join("picture.png");
/// let error = lobe::image::check_writable(missing).unwrap_err();
/// assert!(error.to_string().ends_with("create it first"));
/// ```
pub fn check_writable(path: impl AsRef<Path>) -> Result<(), WriteError> {
    Temporary::beside(path.as_ref()).map(drop)
}

/// Writes a file whole or not at all: the contents go to a temporary file in the same folder, which is flushed to the
/// disk and then renamed to `path`. A file that was there before stays whole until then, and for good when anything
/// fails. Symbolic links to files are followed (one that leads nowhere is replaced), and the permissions of an existing
/// file are kept.
///
/// If the process is killed while it writes, a hidden file `.lobe-*.tmp` may remain in the folder.
///
/// # Errors
/// When the path cannot be written.
pub fn write_file(path: impl AsRef<Path>, contents: &[u8]) -> Result<(), WriteError> {
    replace(path.as_ref(), |file| file.write_all(contents))
}

/// [`write_file`] with contents from a function.
pub(super) fn replace(
    path: &Path,
    write: impl FnOnce(&mut File) -> io::Result<()>,
) -> Result<(), WriteError> {
    let mut temporary = Temporary::beside(path)?;
    write(&mut temporary.file)
        .and_then(|()| temporary.finish())
        .map_err(|error| WriteError::System { path: path.to_owned(), error })
}

/// Where a path leads, after links, once it is known that a file can be there.
struct Target {
    path: PathBuf,
    /// Permissions of the existing file.
    permissions: Option<Permissions>,
}

impl Target {
    fn resolve(path: &Path) -> Result<Self, WriteError> {
        let given = path.to_owned();
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => Err(WriteError::Folder { path: given }),
            Ok(found) if !found.is_file() => Err(WriteError::NotAFile { path: given }),
            Ok(found) if found.permissions().readonly() => {
                Err(WriteError::WriteProtected { path: given })
            }
            Ok(found) => match fs::canonicalize(path) {
                Ok(path) => Ok(Self { path, permissions: Some(found.permissions()) }),
                Err(error) => Err(WriteError::System { path: given, error }),
            },
            Err(error) if is_absence(&error) => Self::new_file(path),
            Err(error) => Err(WriteError::System { path: given, error }),
        }
    }

    fn new_file(path: &Path) -> Result<Self, WriteError> {
        let given = path.to_owned();
        let Some(name) = path.file_name() else {
            return Err(WriteError::NoFileName { path: given });
        };
        let folder = folder_of(path);
        match fs::metadata(folder) {
            Ok(found) if found.is_dir() => Ok(Self { path: folder.join(name), permissions: None }),
            Err(error) if !is_absence(&error) => Err(WriteError::System { path: given, error }),
            _ => Err(WriteError::MissingFolder { path: given, folder: folder.to_owned() }),
        }
    }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

fn is_absence(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory)
}

/// A file with a temporary name in its target's folder. It is removed when dropped before
/// [`finish`](Self::finish) has renamed it.
struct Temporary {
    file: File,
    path: PathBuf,
    target: Target,
}

impl Temporary {
    fn beside(path: &Path) -> Result<Self, WriteError> {
        let target = Target::resolve(path)?;
        match create_hidden(folder_of(&target.path)) {
            Ok((file, path)) => Ok(Self { file, path, target }),
            Err(error) => Err(WriteError::System { path: path.to_owned(), error }),
        }
    }

    /// Flushes to the disk, then renames to the target.
    fn finish(self) -> io::Result<()> {
        if let Some(permissions) = &self.target.permissions {
            self.file.set_permissions(permissions.clone())?;
        }
        self.file.sync_all()?;
        fs::rename(&self.path, &self.target.path)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // After a successful rename this finds no file, which is no error here.
        let _ = fs::remove_file(&self.path);
    }
}

/// Creates a file that no other thread or process uses. Its name does not contain the target's, which may be as long
/// as the file system allows.
fn create_hidden(folder: &Path) -> io::Result<(File, PathBuf)> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    loop {
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = folder.join(format!(".lobe-{}-{count}.tmp", std::process::id()));
        match File::create_new(&path) {
            Ok(file) => return Ok((file, path)),
            // Left by a killed process with the same process id, or created on another host.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
}
