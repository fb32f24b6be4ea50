//! [`Image`]: pixels to be compared, and where they are read from.

use std::fs;
use std::io::{self, Cursor};
use std::path::{Path, PathBuf};

use exr::prelude::{AnyChannels, FlatSamples, ReadChannels, ReadLayers};
use glam::UVec2;

use super::pfm;
use crate::film::Picture;
use crate::spectrum::Spectrum;

/// What the numbers of an image mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Linear radiance, from EXR and PFM files.
    Linear,
    /// A screen's codes from 0 to 1, from PNG files.
    Srgb,
}

/// Pixels of three bands, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Columns and rows, at least one of each.
    pub size: UVec2,
    /// One for each pixel.
    pub pixels: Vec<Spectrum>,
    /// The square of the standard error of each, if it is known.
    pub variance: Option<Vec<Spectrum>>,
    /// What the numbers mean.
    pub encoding: Encoding,
}

/// Why an image could not be read. The message is one sentence: the path, the reason, what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadImageError {
    /// The operating system refused.
    #[error("cannot read `{}`: {error}", .path.display())]
    System {
        /// The path as it was given.
        path: PathBuf,
        /// What the operating system said.
        error: io::Error,
    },
    /// The name ends in something else than a known format.
    #[error("cannot read `{}`: its name has to end in .exr, .pfm or .png", .path.display())]
    Format {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The file is not what its name says, or has no colours.
    #[error("cannot read `{}`: {reason}", .path.display())]
    Contents {
        /// The path as it was given.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
}

impl Image {
    /// Reads an image of the format that its name ends in.
    ///
    /// - EXR: the first layer that has channels `R`, `G` and `B`, or `Y` alone, and `variance.R`, ..., if they are there.
    /// - PFM: of three bands, or one.
    /// - PNG: 8 or 16 bits, its codes from 0 to 1 as they are; opacity is left out.
    ///
    /// # Errors
    /// When the file cannot be read, or is something else.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadImageError> {
        let path = path.as_ref();
        let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
        let decode = match extension.as_deref().and_then(|extension| extension.to_str()) {
            Some("exr") => from_exr,
            Some("pfm") => pfm::decode,
            Some("png") => from_png,
            _ => return Err(ReadImageError::Format { path: path.to_owned() }),
        };
        let bytes = fs::read(path)
            .map_err(|error| ReadImageError::System { path: path.to_owned(), error })?;
        decode(&bytes).map_err(|reason| ReadImageError::Contents { path: path.to_owned(), reason })
    }
}

impl From<&Picture> for Image {
    fn from(picture: &Picture) -> Self {
        Self {
            size: picture.window.size(),
            pixels: picture.color.clone(),
            variance: picture.variance.clone(),
            encoding: Encoding::Linear,
        }
    }
}

fn from_png(bytes: &[u8]) -> Result<Image, String> {
    let image = image::load_from_memory_with_format(bytes, image::ImageFormat::Png)
        .map_err(|error| format!("it is no PNG file: {error}"))?
        .into_rgb32f();
    let size = UVec2::new(image.width(), image.height());
    let pixels = image.pixels().map(|pixel| Spectrum::from(pixel.0)).collect();
    Ok(Image { size, pixels, variance: None, encoding: Encoding::Srgb })
}

fn from_exr(bytes: &[u8]) -> Result<Image, String> {
    let file = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| format!("it is no EXR file that can be read: {error}"))?;
    for layer in &file.layer_data {
        let channels = &layer.channel_data;
        let gray = || bands(channels, ["Y", "Y", "Y"]);
        if let Some(pixels) = bands(channels, ["R", "G", "B"]).or_else(gray) {
            let size = UVec2::new(layer.size.0 as u32, layer.size.1 as u32);
            let variance = bands(channels, ["variance.R", "variance.G", "variance.B"]);
            return Ok(Image { size, pixels, variance, encoding: Encoding::Linear });
        }
    }
    Err("it has no channels R, G and B, nor Y".into())
}

/// Three channels, if they are there.
fn bands(channels: &AnyChannels<FlatSamples>, names: [&str; 3]) -> Option<Vec<Spectrum>> {
    let samples = |name: &str| {
        let channel = channels.list.iter().find(|channel| channel.name == *name)?;
        Some(channel.sample_data.values_as_f32().collect::<Vec<f32>>())
    };
    let [r, g, b] = [samples(names[0])?, samples(names[1])?, samples(names[2])?];
    Some(r.iter().zip(&g).zip(&b).map(|((&r, &g), &b)| Spectrum::new(r, g, b)).collect())
}
