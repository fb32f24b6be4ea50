//! Images that a user names, read within a limit of memory.

use std::path::Path;

use clap::{Args, value_parser};
use lobe::image::{Image, ImageFile, ReadError};

/// The limit on memory.
#[derive(Args)]
pub struct MemoryArgument {
    /// Refuses images that take more memory to read: 16 bytes for each pixel, as much again for variance, and what decoding
    /// takes beside them (of EXR files the whole file). Each image counts for itself, and comparing is not counted
    #[arg(
        long,
        value_name = "MIB",
        default_value_t = Image::DEFAULT_LIMIT >> 20,
        value_parser = value_parser!(u64).range(1..1 << 40)
    )]
    max_image_mb: u64,
}

impl MemoryArgument {
    /// Opens an image and reads its header.
    pub fn open(&self, path: &Path) -> Result<ImageFile, String> {
        ImageFile::open(path, self.max_image_mb << 20).map_err(told)
    }

    /// Reads the pixels.
    pub fn decode(&self, file: ImageFile) -> Result<Image, String> {
        file.decode().map_err(told)
    }
}

/// The message, with the argument that raises the limit.
fn told(error: ReadError) -> String {
    match error {
        ReadError::AboveLimit { .. } => format!("{error}; raise it with --max-image-mb"),
        _ => error.to_string(),
    }
}
