//! [`Output`]: a picture file to be written.

use std::error::Error;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use lobe::image::{Display, Metadata, Picture, WriteError, check_writable, write_exr, write_png};
use lobe::params::Shown;

/// An output file. The extension of its name selects the format.
pub struct Output {
    pub path: PathBuf,
    pub format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Format {
    Png,
    Exr,
}

impl Output {
    /// The files given on the command line, or NAME.png and NAME.exr for a scene NAME.toml. Checks that all of them can
    /// be written, before anything is rendered.
    pub fn all(named: &[PathBuf], scene: &Path) -> Result<Vec<Self>, Box<dyn Error>> {
        if !named.is_empty() {
            return named.iter().map(|path| Self::new(path.clone())).collect();
        }
        let default = |extension| {
            let mut name: OsString = scene.file_stem().unwrap_or("scene".as_ref()).to_owned();
            name.push(extension);
            Self::new(name.into())
        };
        [".png", ".exr"].into_iter().map(default).collect()
    }

    fn new(path: PathBuf) -> Result<Self, Box<dyn Error>> {
        let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
        let format = match extension.as_deref().and_then(|extension| extension.to_str()) {
            Some("png") => Format::Png,
            Some("exr") => Format::Exr,
            _ => {
                let path = Shown::path(&path);
                return Err(
                    format!("cannot write `{path}`: its name has to end in .png or .exr").into()
                );
            }
        };
        check_writable(&path)?;
        Ok(Self { path, format })
    }

    /// Writes the picture.
    pub fn write(
        &self,
        picture: &Picture,
        display: Display,
        metadata: &Metadata,
    ) -> Result<(), WriteError> {
        match self.format {
            Format::Png => write_png(&self.path, picture, display, metadata),
            Format::Exr => write_exr(&self.path, picture, metadata),
        }
    }
}
