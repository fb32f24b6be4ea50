//! Pictures in memory, and reading and writing them as PNG, OpenEXR and PFM files, and reading JPEG files.
//!
//! There are two kinds of pictures. A [`Picture`] is what a render gives: linear radiance for a [`Window`] of the image,
//! with the variance of each pixel and [`Layers`] about the first hits if they were asked for. An [`Image`] is what was
//! read from a file: pixels, whose [`Encoding`] says whether they are linear or encoded for a screen. A `Picture` turns
//! into an `Image` by `Image::from`.
//!
//! | format | write | read | pixels |
//! |---|---|---|---|
//! | OpenEXR (feature `exr`) | [`write_exr`] | [`Image::read`] | linear `f32`, with variance and layers |
//! | PNG | [`write_png`], [`encode_png`] | [`Image::read`] | 8-bit codes of a [`Display`] curve; 16 bits are read, too |
//! | JPEG | | [`Image::read`] | codes of 8 bits |
//! | PFM | [`write_pfm`] | [`Image::read`] | linear `f32`, colour alone |
//!
//! Files are written whole or not at all: see [`write_file`]. Reading stays within a limit of memory and refuses files that
//! are incomplete; [`ImageFile`] reads the header alone. Colours are linear Rec. 709 with white point D65.
//!
//! ```
//! # #[cfg(feature = "exr")] {
//! use lobe::Spectrum;
//! use lobe::glam::UVec2;
//! use lobe::image::{Display, Encoding, Image, Metadata, Picture, write_exr, write_png};
//!
//! let color = vec![Spectrum::new(0.5, 0.0, 1.0), Spectrum::new(0.25, 0.1, 3.0)];
//! let picture = Picture::new(UVec2::new(2, 1), color);
//! # let folder = std::env::temp_dir().join(format!("lobe-image-example-{}", std::process::id()));
//! # std::fs::create_dir_all(&folder)?;
//! let (png, exr) = (folder.join("picture.png"), folder.join("picture.exr"));
//! write_png(&png, &picture, Display::Srgb, &Metadata::default())?;
//! write_exr(&exr, &picture, &Metadata::default())?;
//!
//! // An EXR file holds the radiance bit for bit.
//! assert_eq!(Image::read(&exr)?, Image::from(&picture));
//! // A PNG file holds codes of the sRGB curve: 0.5 is shown as 188 of 255, and 3.0 as 255.
//! let shown = Image::read(&png)?;
//! assert_eq!(shown.encoding, Encoding::Srgb);
//! assert_eq!(shown.pixels[0], Spectrum::new(188.0 / 255.0, 0.0, 1.0));
//! # std::fs::remove_dir_all(&folder)?;
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod atomic;
mod codes;
mod decoded;
mod display;
mod error;
#[cfg(feature = "exr")]
mod exr;
#[cfg(feature = "exr")]
mod exr_blocks;
#[cfg(feature = "exr")]
mod exr_part;
#[cfg(feature = "exr")]
mod exr_read;
mod jpeg;
mod memory;
mod metadata;
mod pfm;
mod picture;
mod png;
mod read;
mod signature;
mod window;

pub use atomic::{
    check_writable, is_temporary, sweep_temporaries, write_file, write_file_with, write_files,
};
pub use decoded::{Encoding, Image};
pub use display::Display;
pub use error::{EncodeError, ReadError, WriteError};
#[cfg(feature = "exr")]
pub use exr::{exr_bytes, write_exr};
pub(crate) use memory::try_reserve;
pub use metadata::{Metadata, ParsePartError, PartMetadata};
pub use pfm::write_pfm;
pub use picture::{Layers, Picture, Plane};
pub use png::{encode_png, png_bytes, write_png};
pub use read::ImageFile;
pub use window::Window;
