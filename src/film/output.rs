//! Writing files so that a name never stands for half a picture, and [`OutputError`].

use std::fs::{self, File, Permissions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Why a picture could not be written. The message is one sentence: the path, the reason, what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The path ends in nothing that could be a file's name, as `..` does.
    #[error("cannot write `{}`: it names no file; give a file name such as picture.png", .path.display())]
    NoFileName {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The path names a folder.
    #[error("cannot write `{}`: it is a folder; give the name of a file in it", .path.display())]
    Folder {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The path names a device, a pipe or a socket, which a finished file cannot replace.
    #[error("cannot write `{}`: it is not an ordinary file; give the name of a new file", .path.display())]
    NotAFile {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The file exists and nobody may write to it.
    #[error("cannot write `{}`: the file is write-protected; allow writing or give another name", .path.display())]
    WriteProtected {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The folder that the file should lie in does not exist.
    #[error("cannot write `{}`: there is no folder `{}`; create it first", .path.display(), .folder.display())]
    MissingFolder {
        /// The path as it was given.
        path: PathBuf,
        /// The folder that is missing.
        folder: PathBuf,
    },
    /// The operating system refused: no permission, no space, ...
    #[error("cannot write `{}`: {error}; {}", .path.display(), advice(.error))]
    System {
        /// The path as it was given.
        path: PathBuf,
        /// What the operating system said.
        error: io::Error,
    },
    /// The parts of the picture contradict each other, or it is too large for the format.
    #[error("cannot write `{}`: {reason}; mend the picture", .path.display())]
    Picture {
        /// The path as it was given.
        path: PathBuf,
        /// What is wrong with the picture.
        reason: String,
    },
}

fn advice(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "choose a folder that you may write to"
        }
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded | io::ErrorKind::FileTooLarge => {
            "free some space or choose another disk"
        }
        io::ErrorKind::InvalidFilename => "choose a shorter name",
        _ => "try another path",
    }
}

/// Finds out whether a picture can be written to `path`, before time is spent on rendering it.
///
/// It creates an empty file of a temporary name in the same folder and removes it again. It leaves
/// nothing behind and does not touch a file that already has the name. That there will be enough
/// space for the picture it cannot promise.
///
/// # Errors
/// What [`write_png`](super::write_png) and [`write_exr`](super::write_exr) would fail with.
///
/// ```
/// # let missing = std::env::temp_dir().join("lobe no such folder").join("picture.png");
/// let error = lobe::film::check_writable(missing).unwrap_err();
/// assert!(error.to_string().ends_with("create it first"));
/// ```
pub fn check_writable(path: impl AsRef<Path>) -> Result<(), OutputError> {
    Temporary::beside(path.as_ref()).map(drop)
}

/// Gives `path` new contents, as [`write_png`](super::write_png) does: a file of the same name is replaced only when
/// the new one is complete and on the disk.
///
/// # Errors
/// When the path cannot be written.
pub fn write_file(path: impl AsRef<Path>, contents: &[u8]) -> Result<(), OutputError> {
    replace(path.as_ref(), |file| file.write_all(contents))
}

/// Gives `path` new contents, all or nothing: they go to a temporary file in the same folder, which
/// is flushed to the disk and then takes the name. An earlier file stays whole until that moment,
/// and for good when anything fails. A link is followed; the earlier file's permissions are kept.
pub(super) fn replace(
    path: &Path,
    write: impl FnOnce(&mut File) -> io::Result<()>,
) -> Result<(), OutputError> {
    let mut temporary = Temporary::beside(path)?;
    write(&mut temporary.file)
        .and_then(|()| temporary.finish())
        .map_err(|error| OutputError::System { path: path.to_owned(), error })
}

/// Where a path leads, once it is known that a file can stand there.
struct Target {
    path: PathBuf,
    /// Those of the file that is there already.
    permissions: Option<Permissions>,
}

impl Target {
    fn resolve(path: &Path) -> Result<Self, OutputError> {
        let given = path.to_owned();
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => Err(OutputError::Folder { path: given }),
            Ok(found) if !found.is_file() => Err(OutputError::NotAFile { path: given }),
            Ok(found) if found.permissions().readonly() => {
                Err(OutputError::WriteProtected { path: given })
            }
            Ok(found) => match fs::canonicalize(path) {
                Ok(path) => Ok(Self { path, permissions: Some(found.permissions()) }),
                Err(error) => Err(OutputError::System { path: given, error }),
            },
            Err(error) if is_absence(&error) => Self::new_file(path),
            Err(error) => Err(OutputError::System { path: given, error }),
        }
    }

    fn new_file(path: &Path) -> Result<Self, OutputError> {
        let given = path.to_owned();
        let Some(name) = path.file_name() else {
            return Err(OutputError::NoFileName { path: given });
        };
        let folder = folder_of(path);
        match fs::metadata(folder) {
            Ok(found) if found.is_dir() => Ok(Self { path: folder.join(name), permissions: None }),
            Err(error) if !is_absence(&error) => Err(OutputError::System { path: given, error }),
            _ => Err(OutputError::MissingFolder { path: given, folder: folder.to_owned() }),
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

/// A file of a temporary name beside its target. Dropped before [`finish`](Self::finish), it is
/// removed, for whatever reason that happens.
struct Temporary {
    file: File,
    path: PathBuf,
    target: Target,
}

impl Temporary {
    fn beside(path: &Path) -> Result<Self, OutputError> {
        let target = Target::resolve(path)?;
        match create_hidden(folder_of(&target.path)) {
            Ok((file, path)) => Ok(Self { file, path, target }),
            Err(error) => Err(OutputError::System { path: path.to_owned(), error }),
        }
    }

    /// Flush to the disk, then take the target's name.
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
        // After a successful rename there is nothing of this name, and nothing to remove.
        let _ = fs::remove_file(&self.path);
    }
}

/// A new file that no other thread or process uses. Its name does not depend on the target's, which
/// may be as long as the file system allows.
fn create_hidden(folder: &Path) -> io::Result<(File, PathBuf)> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    loop {
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = folder.join(format!(".lobe-{}-{count}.tmp", std::process::id()));
        match File::create_new(&path) {
            Ok(file) => return Ok((file, path)),
            // Left by a process that was killed and had the same number, or on another host.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
}
