//! [`Output`]: a picture file to be written.

use std::error::Error;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use lobe::image::{
    Display, EncodeError, Metadata, Picture, check_writable, exr_bytes, png_bytes, write_file,
    write_files,
};
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
    /// The files given on the command line, or for a scene NAME.toml or NAME.obj the file name NAME with each of these endings. Checks
    /// that all of them can be written, before anything is rendered.
    pub fn all(
        named: &[PathBuf],
        scene: &Path,
        endings: &[String],
    ) -> Result<Vec<Self>, Box<dyn Error>> {
        if !named.is_empty() {
            return named.iter().map(|path| Self::new(path.clone())).collect();
        }
        let default = |ending: &String| {
            let mut name: OsString = scene.file_stem().unwrap_or("scene".as_ref()).to_owned();
            name.push(ending);
            Self::new(name.into())
        };
        endings.iter().map(default).collect()
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

    /// Refuses outputs that are among the files `read`, or the same file twice.
    pub fn check_own(outputs: &[Self], read: &[PathBuf]) -> Result<(), Box<dyn Error>> {
        let paths: Vec<&Path> = outputs.iter().map(|output| &*output.path).collect();
        check_own(&paths, read)
    }

    fn bytes(
        &self,
        picture: &Picture,
        display: Display,
        metadata: &Metadata,
    ) -> Result<Vec<u8>, EncodeError> {
        match self.format {
            Format::Png => png_bytes(picture, display, metadata),
            Format::Exr => exr_bytes(picture, metadata),
        }
    }

    /// Writes the picture to all outputs, or to none if one of them cannot be written.
    pub fn write_all(
        outputs: &[Self],
        picture: &Picture,
        display: Display,
        metadata: &Metadata,
    ) -> Result<(), Box<dyn Error>> {
        let bytes = outputs.iter().map(|output| output.bytes(picture, display, metadata));
        let bytes: Vec<_> = bytes.collect::<Result<_, _>>()?;
        let files = outputs.iter().zip(&bytes).map(|(output, bytes)| (&*output.path, &bytes[..]));
        Ok(write_files(&files.collect::<Vec<_>>())?)
    }

    /// [`write_all`](Self::write_all); where that fails, writes what can be written under other names, beside the outputs
    /// or in the system's folder for temporary files, and tells which.
    pub fn write_or_keep(
        outputs: &[Self],
        picture: &Picture,
        display: Display,
        metadata: &Metadata,
    ) -> Result<(), Box<dyn Error>> {
        let Err(error) = Self::write_all(outputs, picture, display, metadata) else {
            return Ok(());
        };
        let kept = outputs.iter().filter_map(|output| {
            let bytes = output.bytes(picture, display, metadata).ok()?;
            output.other_names().find(|path| write_file(path, &bytes).is_ok())
        });
        let kept: Vec<_> = kept.map(|path| format!("`{}`", Shown::path(&path))).collect();
        Err(match kept.as_slice() {
            [] => format!("{error}; the picture could not be kept anywhere else").into(),
            kept => format!("{error}; the picture is kept in {}", kept.join(" and ")).into(),
        })
    }

    /// Names of no files yet, for a picture that cannot be written where it should be.
    fn other_names(&self) -> impl Iterator<Item = PathBuf> {
        let name = self.path.file_name().unwrap_or_default();
        let folders = [self.path.with_file_name(""), std::env::temp_dir()];
        let names = (0..100).map(move |number| {
            let mut other = OsString::from(format!("kept-{number}-"));
            other.push(name);
            other
        });
        let free = folders.map(|folder| {
            let mut paths = names.clone().map(|name| folder.join(name));
            paths.find(|path| fs::symlink_metadata(path).is_err())
        });
        free.into_iter().flatten()
    }
}

/// Refuses outputs that are among the files `read`, or the same file twice.
pub fn check_own(outputs: &[&Path], read: &[PathBuf]) -> Result<(), Box<dyn Error>> {
    // Of a file that does not exist yet, by its folder.
    let real = |path: &Path| {
        let folder = path.parent().filter(|folder| *folder != Path::new(""));
        let folder = fs::canonicalize(folder.unwrap_or(Path::new("."))).ok();
        fs::canonicalize(path).ok().or_else(|| Some(folder?.join(path.file_name()?)))
    };
    let read: Vec<_> = read.iter().filter_map(|path| real(path)).collect();
    for (index, path) in outputs.iter().enumerate() {
        let shown = Shown::path(path);
        if real(path).is_some_and(|path| read.contains(&path)) {
            let what = format!("cannot write `{shown}`: it is read; give another name");
            return Err(what.into());
        }
        let is_same = |other: &&Path| other == path || real(path) == real(other);
        if outputs[..index].iter().any(is_same) {
            return Err(format!("`{shown}` is given twice: give each output once").into());
        }
    }
    Ok(())
}
