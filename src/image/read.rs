//! [`Image::read`]: the format is chosen by the file's name.

use std::fs;
use std::path::Path;

#[cfg(feature = "exr")]
use super::exr;
use super::{Image, ReadError, pfm, png};

impl Image {
    /// Reads an image. The extension of the name chooses the format: `.exr`, `.pfm` or `.png`, in any case.
    ///
    /// - EXR, with the feature `exr`: the first layer with channels `R`, `G` and `B`, or `Y` alone; with `variance.R`, `variance.G` and
    ///   `variance.B`, if they exist.
    /// - PFM: three bands, or one, which stands for all three.
    /// - PNG: 8 or 16 bits; codes are scaled to `[0, 1]` and stay encoded. Opacity is ignored.
    ///
    /// # Errors
    /// When the file cannot be read, or is not of the format that its name says, or lobe was built without that format.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
        let decode = match extension.as_deref().and_then(|extension| extension.to_str()) {
            #[cfg(feature = "exr")]
            Some("exr") => exr::decode,
            #[cfg(not(feature = "exr"))]
            Some("exr") => return Err(ReadError::Unsupported { path: path.to_owned() }),
            Some("pfm") => pfm::decode,
            Some("png") => png::decode,
            _ => return Err(ReadError::Format { path: path.to_owned() }),
        };
        let bytes =
            fs::read(path).map_err(|error| ReadError::System { path: path.to_owned(), error })?;
        decode(&bytes).map_err(|reason| ReadError::Contents { path: path.to_owned(), reason })
    }
}

#[cfg(all(test, not(feature = "exr")))]
mod tests {
    use super::*;

    /// Seen to fail with the arm of this error left out: "its name has to end in .exr, .pfm or .png".
    #[test]
    fn exr_is_refused_by_a_build_without_it() {
        let error = Image::read("a.EXR").unwrap_err();
        let expected = "cannot read `a.EXR`: unsupported: built without the feature exr";
        assert_eq!(error.to_string(), expected);
    }
}
