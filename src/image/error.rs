//! Why a picture could not be read or written.

use std::io;
use std::path::PathBuf;

use crate::params::Shown;

/// Why a file could not be read as an image. The message names the path, the reason and what would be accepted.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file does not exist.
    #[error("cannot read `{}`: there is no such file", Shown::path(.path))]
    Missing {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The path names a folder.
    #[error("cannot read `{}`: it is a folder; give the name of a file in it", Shown::path(.path))]
    Folder {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The path names a device, a pipe or a socket, which have no size and may never end.
    #[error("cannot read `{}`: it is not an ordinary file; copy its contents to one first", Shown::path(.path))]
    NotAFile {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The operating system refused.
    #[error("cannot read `{}`: {error}", Shown::path(.path))]
    System {
        /// The path as it was given.
        path: PathBuf,
        /// The operating system's error.
        error: io::Error,
    },
    /// The file name does not end in a known format.
    #[error("cannot read `{}`: its name has to end in .exr, .jpg, .jpeg, .pfm or .png", Shown::path(.path))]
    Format {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The file is OpenEXR, and lobe was built without the feature `exr`.
    #[error("cannot read `{}`: unsupported: built without the feature exr", Shown::path(.path))]
    Unsupported {
        /// The path as it was given.
        path: PathBuf,
    },
    /// Reading would take more memory than the limit, by what the file's size or its header says.
    #[error("cannot read `{}`: {reason}", Shown::path(.path))]
    AboveLimit {
        /// The path as it was given.
        path: PathBuf,
        /// What takes how much, and the limit.
        reason: String,
    },
    /// Reading takes more memory than there is.
    #[error("cannot read `{}`: {} MiB of memory are not available", Shown::path(.path), .bytes.div_ceil(1 << 20))]
    OutOfMemory {
        /// The path as it was given.
        path: PathBuf,
        /// Bytes that were asked for.
        bytes: u64,
    },
    /// The contents are not of the format that the name says, are incomplete, or have no colours.
    #[error("cannot read `{}`: {reason}", Shown::path(.path))]
    Contents {
        /// The path as it was given.
        path: PathBuf,
        /// What is wrong with the contents.
        reason: String,
    },
}

/// Why a picture cannot be encoded: its parts contradict each other, or it is too large for the format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct EncodeError(pub(super) String);

/// Why a file could not be written. The message names the path, the reason and what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The path does not end in a file name, as `..` does not.
    #[error("cannot write `{}`: it names no file; give a file name such as picture.png", Shown::path(.path))]
    NoFileName {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The path names a folder.
    #[error("cannot write `{}`: it is a folder; give the name of a file in it", Shown::path(.path))]
    Folder {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The path names a device, a pipe or a socket, which a finished file cannot replace.
    #[error("cannot write `{}`: it is not an ordinary file; give the name of a new file", Shown::path(.path))]
    NotAFile {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The file exists and is read-only.
    #[error("cannot write `{}`: the file is write-protected; allow writing or give another name", Shown::path(.path))]
    WriteProtected {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The folder for the file does not exist.
    #[error("cannot write `{}`: there is no folder `{}`; create it first", Shown::path(.path), Shown::path(.folder))]
    MissingFolder {
        /// The path as it was given.
        path: PathBuf,
        /// The folder that is missing.
        folder: PathBuf,
    },
    /// The operating system refused: no permission, no space, ...
    #[error("cannot write `{}`: {error}; {}", Shown::path(.path), advice(.error))]
    System {
        /// The path as it was given.
        path: PathBuf,
        /// The operating system's error.
        error: io::Error,
    },
    /// The picture cannot be encoded.
    #[error("cannot write `{}`: {error}; mend the picture", Shown::path(.path))]
    Picture {
        /// The path as it was given.
        path: PathBuf,
        /// What is wrong with the picture.
        error: EncodeError,
    },
}

/// What to do about an error of the operating system.
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
