//! Writing files whole or not at all.

use std::fs::{self, File, Permissions, TryLockError};
use std::hash::{BuildHasher, RandomState};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::WriteError;

/// Checks that a file can be written to `path`, before time is spent on rendering it.
///
/// Creates an empty file with a temporary name in the same folder and removes it again, and with it what killed processes
/// left of such files. An existing file at `path` is not touched. Whether there will be enough space is not checked.
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
    let temporary = Temporary::beside(path.as_ref())?;
    sweep_temporaries(folder_of(&temporary.path));
    Ok(())
}

/// Writes a file whole or not at all: the contents go to a temporary file in the same folder, which is flushed to the
/// disk and then renamed to `path`. A file that was there before stays whole until then, and for good when anything
/// fails. Symbolic links are followed, and the permissions of an existing file are kept.
///
/// If the process is killed while it writes, a hidden file `.lobe-*.tmp` may remain in the folder, until
/// [`check_writable`] is called for a file there.
///
/// # Errors
/// When the path cannot be written.
pub fn write_file(path: impl AsRef<Path>, contents: &[u8]) -> Result<(), WriteError> {
    write_file_with(path, |file| file.write_all(contents))
}

/// [`write_file`] with contents from a function.
///
/// # Errors
/// When the path cannot be written, and those of `write`.
pub fn write_file_with(
    path: impl AsRef<Path>,
    write: impl FnOnce(&mut File) -> io::Result<()>,
) -> Result<(), WriteError> {
    Temporary::filled(path.as_ref(), write)?.finish()
}

/// Writes several files, all or none: renaming begins when the contents of all are on the disk. A process that is killed
/// between two of the renames, which take microseconds, leaves some files new and others old.
///
/// # Errors
/// When one of the paths cannot be written: then all files are as they were, unless it was a renaming that failed.
pub fn write_files(files: &[(&Path, &[u8])]) -> Result<(), WriteError> {
    let filled = files
        .iter()
        .map(|(path, contents)| Temporary::filled(path, |file| file.write_all(contents)));
    let filled: Vec<_> = filled.collect::<Result<_, _>>()?;
    filled.into_iter().try_for_each(Temporary::finish)
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
        let path = &follow_dangling(path);
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
            Err(error) if is_absence(&error) => Self::new_file(path, given),
            Err(error) => Err(WriteError::System { path: given, error }),
        }
    }

    /// `given` is the path before links were followed.
    fn new_file(path: &Path, given: PathBuf) -> Result<Self, WriteError> {
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

/// Where a chain of links ends that leads to no file yet; other paths as they are.
fn follow_dangling(path: &Path) -> PathBuf {
    // As many links as Linux follows.
    const MOST: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MOST {
        let Ok(next) = fs::read_link(&path) else { break };
        path = folder_of(&path).join(next);
    }
    path
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
    /// The target as the caller named it.
    given: PathBuf,
    is_renamed: bool,
}

impl Temporary {
    fn beside(path: &Path) -> Result<Self, WriteError> {
        let (target, given) = (Target::resolve(path)?, path.to_owned());
        match create_hidden(folder_of(&target.path)) {
            Ok((file, path)) => Ok(Self { file, path, target, given, is_renamed: false }),
            Err(error) => Err(WriteError::System { path: given, error }),
        }
    }

    /// A file for `path` with contents from a function, flushed to the disk.
    fn filled(
        path: &Path,
        write: impl FnOnce(&mut File) -> io::Result<()>,
    ) -> Result<Self, WriteError> {
        let mut temporary = Self::beside(path)?;
        let Self { file, target, .. } = &mut temporary;
        let filled = write(file)
            .and_then(|()| target.permissions.clone().map_or(Ok(()), |p| file.set_permissions(p)))
            .and_then(|()| file.sync_all());
        match filled {
            Ok(()) => Ok(temporary),
            Err(error) => Err(WriteError::System { path: path.to_owned(), error }),
        }
    }

    /// Renames to the target.
    fn finish(mut self) -> Result<(), WriteError> {
        fs::rename(&self.path, &self.target.path)
            .map_err(|error| WriteError::System { path: self.given.clone(), error })?;
        self.is_renamed = true;
        Ok(())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // After renaming, another process may have a file of this name.
        if !self.is_renamed {
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// How the names of temporary files begin and end. They do not contain the target's name, which may be as long as the file
/// system allows.
const NAME: (&str, &str) = (".lobe-", ".tmp");

/// Creates a file that no other thread or process uses, and locks it: [`sweep_temporaries`] removes files that nobody has locked.
fn create_hidden(folder: &Path) -> io::Result<(File, PathBuf)> {
    loop {
        // Random: process ids are the same in many containers.
        let number = RandomState::new().hash_one(std::process::id());
        let path = folder.join(format!("{}{}-{number}{}", NAME.0, std::process::id(), NAME.1));
        match File::create_new(&path) {
            // A file that another process sweeps at this moment is locked by it, or gone when this one has locked it.
            Ok(file) => match file.try_lock() {
                Err(TryLockError::WouldBlock) => {}
                // A file system without locks sweeps nothing.
                Ok(()) | Err(TryLockError::Error(_)) if path.exists() => return Ok((file, path)),
                _ => {}
            },
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
}

/// Whether a file of this name is a temporary one.
pub fn is_temporary(name: &str) -> bool {
    name.strip_prefix(NAME.0)
        .and_then(|rest| rest.strip_suffix(NAME.1))
        .and_then(|numbers| numbers.split_once('-'))
        .is_some_and(|(id, number)| id.parse::<u32>().is_ok() && number.parse::<u64>().is_ok())
}

/// Removes the temporary files that killed processes left in a folder, whatever they were for. Their lock ended with them.
pub fn sweep_temporaries(folder: &Path) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for path in entries.map(|entry| entry.path()) {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let is_file = || fs::symlink_metadata(&path).is_ok_and(|found| found.is_file());
        if is_temporary(name)
            && is_file()
            && let Ok(file) = File::open(&path)
            && file.try_lock().is_ok()
        {
            // Still locked, so that nobody else begins to use it.
            let _ = fs::remove_file(&path);
        }
    }
}
