//! [`ImageFile`]: the format is chosen by the file's name, and the header is read before the pixels.

use std::fs::{self, File};
use std::io::{BufRead, BufReader, Cursor, ErrorKind, Seek};
use std::path::{Path, PathBuf};

use glam::UVec2;

use super::memory::{self, Refusal, mebibytes};
use super::{Encoding, Image, ReadError, jpeg, pfm, png, signature};
#[cfg(feature = "exr")]
use super::{Metadata, Picture};
#[cfg(feature = "exr")]
use super::{exr_part, exr_read};

impl Image {
    /// The limit on the memory that [`Image::read`] may take: 4096 MiB, enough for 16384 x 8192 pixels of linear radiance.
    pub const DEFAULT_LIMIT: u64 = 4096 << 20;

    /// Reads an image. The extension of the name chooses the format: `.exr`, `.jpg` or `.jpeg`, `.pfm` or `.png`, in any case.
    ///
    /// - EXR, with the feature `exr`: the first layer with channels `R`, `G` and `B`, or `Y` alone; with `variance.R`, `variance.G` and
    ///   `variance.B`, if they exist.
    /// - JPEG: codes are scaled to `[0, 1]` and stay encoded.
    /// - PFM: three bands, or one, which stands for all three.
    /// - PNG: 8 or 16 bits; codes are scaled to `[0, 1]` and stay encoded. Opacity is ignored.
    ///
    /// Takes at most [`Image::DEFAULT_LIMIT`] bytes of memory; [`ImageFile::open`] takes a limit of one's own.
    ///
    /// # Errors
    /// When there is no such file, or it is not an ordinary one; when it cannot be read, is incomplete, or is not of the
    /// format that its name says; when reading it would take more memory than the limit or than there is; or when lobe
    /// was built without that format.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        ImageFile::open(path, Self::DEFAULT_LIMIT)?.decode()
    }

    /// Reads an image from the bytes of a file. `name` chooses the format by its extension and stands in errors. `limit`
    /// is as for [`ImageFile::open`].
    ///
    /// # Errors
    /// As [`Image::read`].
    ///
    /// ```
    /// let pixel: Vec<u8> = [1.0_f32, 0.5, 0.25].into_iter().flat_map(f32::to_le_bytes).collect();
    /// let image = lobe::image::Image::parse("one.pfm", &[b"PF\n1 1\n-1\n", &pixel[..]].concat(), 1 << 20)?;
    /// assert_eq!(image.pixels[0].to_array(), [1.0, 0.5, 0.25]);
    /// # Ok::<(), lobe::image::ReadError>(())
    /// ```
    pub fn parse(name: impl AsRef<Path>, bytes: &[u8], limit: u64) -> Result<Self, ReadError> {
        let path = name.as_ref();
        let decoded = Format::of(path)?.decode(Cursor::new(bytes), bytes.len() as u64, limit);
        decoded.map_err(|refusal| refused(path, refusal))
    }
}

impl Image {
    /// Checks that the pixels and this many more bytes for each stay within a limit, for what is made of an image of this file.
    pub(crate) fn check_beside(&self, path: &Path, more: u64, limit: u64) -> Result<(), ReadError> {
        let own = memory::PIXEL * if self.variance.is_some() { 2 } else { 1 };
        let bytes = u128::from(memory::area(self.size)) * (own + u128::from(more));
        memory::check(self.size, bytes, limit).map_err(|refusal| refused(path, refusal))
    }
}

/// An image file whose header was read, and whose pixels were not.
///
/// So sizes can be compared, and what is too large refused, before anything takes time or memory.
///
/// ```no_run
/// use lobe::image::{Image, ImageFile};
///
/// let file = ImageFile::open("sky.exr", Image::DEFAULT_LIMIT)?;
/// println!("{} x {} pixels", file.size().x, file.size().y);
/// let image = file.decode()?;
/// # Ok::<(), lobe::image::ReadError>(())
/// ```
#[derive(Debug)]
pub struct ImageFile {
    path: PathBuf,
    file: File,
    /// Bytes of the file.
    length: u64,
    format: Format,
    size: UVec2,
    limit: u64,
}

impl ImageFile {
    /// Opens an image file and reads its header. Formats and names are those of [`Image::read`].
    ///
    /// `limit` is the most memory in bytes that reading may take: the pixels as an [`Image`] has them, 16 bytes each and
    /// as much again for variance, and what decoding takes beside them. A fixed part of less than 100 MiB is not counted.
    ///
    /// # Errors
    /// As [`Image::read`], with this limit.
    pub fn open(path: impl AsRef<Path>, limit: u64) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let format = Format::of(path)?;
        let system = |error: std::io::Error| match error.kind() {
            ErrorKind::NotFound => ReadError::Missing { path: path.to_owned() },
            _ => ReadError::System { path: path.to_owned(), error },
        };
        // Before it is opened, which waits at a pipe for a writer.
        let found = fs::metadata(path).map_err(system)?;
        if found.is_dir() {
            return Err(ReadError::Folder { path: path.to_owned() });
        }
        if !found.is_file() {
            return Err(ReadError::NotAFile { path: path.to_owned() });
        }
        let file = File::open(path).map_err(system)?;
        let length = file.metadata().map_err(system)?.len();
        if length > limit {
            let (has, limit) = (mebibytes(length.into()), limit >> 20);
            let reason = format!("the file has {has} MiB, above the limit of {limit} MiB");
            return Err(refused(path, Refusal::AboveLimit(reason)));
        }
        let size = format
            .size(BufReader::new(&file), length, limit)
            .map_err(|refusal| refused(path, refusal))?;
        Ok(Self { path: path.to_owned(), file, length, format, size, limit })
    }

    /// Columns and rows, at least one of each.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// What the numbers mean.
    pub fn encoding(&self) -> Encoding {
        match self.format {
            Format::Jpeg | Format::Png => Encoding::Srgb,
            _ => Encoding::Linear,
        }
    }

    /// Reads the pixels.
    ///
    /// # Errors
    /// As [`Image::read`], with the limit that the file was opened with.
    pub fn decode(self) -> Result<Image, ReadError> {
        let Self { path, mut file, length, format, limit, .. } = self;
        file.rewind().map_err(|error| ReadError::System { path: path.clone(), error })?;
        let decoded = format.decode(BufReader::new(file), length, limit);
        decoded.map_err(|refusal| refused(&path, refusal))
    }
}

/// Parts of renders, which EXR files hold.
#[cfg(feature = "exr")]
impl ImageFile {
    /// How the picture was made, with its [`part`](Metadata::part); from the header alone.
    ///
    /// # Errors
    /// If it is not a part of a render, and as [`Image::read`].
    pub fn part(&self) -> Result<Metadata, ReadError> {
        self.read_part(exr_part::metadata)
    }

    /// A picture whose [`planes`](Picture::planes) hold what the film of the part kept, without colours, and how it was made.
    ///
    /// # Errors
    /// As [`part`](Self::part).
    pub fn decode_part(&self) -> Result<(Picture, Metadata), ReadError> {
        self.read_part(exr_part::decode)
    }

    fn read_part<'a, T>(
        &'a self,
        read: impl Fn(BufReader<&'a File>, u64, u64) -> Result<T, Refusal>,
    ) -> Result<T, ReadError> {
        let Self { path, length, format, limit, .. } = self;
        let mut file = &self.file;
        file.rewind().map_err(|error| ReadError::System { path: path.clone(), error })?;
        match format {
            Format::Exr => read(BufReader::new(file), *length, *limit),
            _ => Err("it is not an EXR file, which parts of renders are".into()),
        }
        .map_err(|refusal| refused(path, refusal))
    }
}

fn refused(path: &Path, refusal: Refusal) -> ReadError {
    let path = path.to_owned();
    match refusal {
        Refusal::Contents(reason) => ReadError::Contents { path, reason },
        Refusal::AboveLimit(reason) => ReadError::AboveLimit { path, reason },
        Refusal::OutOfMemory(bytes) => ReadError::OutOfMemory { path, bytes },
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    #[cfg(feature = "exr")]
    Exr,
    Jpeg,
    Pfm,
    Png,
}

impl Format {
    /// The format that the extension of a name says.
    fn of(path: &Path) -> Result<Self, ReadError> {
        let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
        match extension.as_deref().and_then(|extension| extension.to_str()) {
            #[cfg(feature = "exr")]
            Some("exr") => Ok(Self::Exr),
            #[cfg(not(feature = "exr"))]
            Some("exr") => Err(ReadError::Unsupported { path: path.to_owned() }),
            Some("jpg" | "jpeg") => Ok(Self::Jpeg),
            Some("pfm") => Ok(Self::Pfm),
            Some("png") => Ok(Self::Png),
            _ => Err(ReadError::Format { path: path.to_owned() }),
        }
    }

    /// With its article.
    const fn name(self) -> &'static str {
        match self {
            #[cfg(feature = "exr")]
            Self::Exr => "an EXR",
            Self::Jpeg => "a JPEG",
            Self::Pfm => "a PFM",
            Self::Png => "a PNG",
        }
    }

    /// Columns and rows of an image that would stay within the limit, by its header.
    fn size(
        self,
        mut source: impl BufRead + Seek,
        length: u64,
        limit: u64,
    ) -> Result<UVec2, Refusal> {
        signature::check(&mut source, self.name())?;
        match self {
            #[cfg(feature = "exr")]
            Self::Exr => exr_read::size(source, length, limit),
            Self::Jpeg => jpeg::size(source, length, limit),
            Self::Pfm => pfm::size(source, length, limit),
            Self::Png => png::size(source, limit),
        }
    }

    fn decode(
        self,
        mut source: impl BufRead + Seek,
        length: u64,
        limit: u64,
    ) -> Result<Image, Refusal> {
        signature::check(&mut source, self.name())?;
        match self {
            #[cfg(feature = "exr")]
            Self::Exr => exr_read::decode(source, length, limit),
            Self::Jpeg => jpeg::decode(source, length, limit),
            Self::Pfm => pfm::decode(source, length, limit),
            Self::Png => png::decode(source, limit),
        }
    }
}

#[cfg(all(test, not(feature = "exr")))]
mod tests {
    use super::*;

    /// Seen to fail with the arm of this error left out: "its name has to end in .exr, .jpg, .jpeg, .pfm or .png".
    #[test]
    fn exr_is_refused_by_a_build_without_it() {
        let error = Image::read("a.EXR").unwrap_err();
        let expected = "cannot read `a.EXR`: unsupported: built without the feature exr";
        assert_eq!(error.to_string(), expected);
    }
}
