//! PNG files: 8-bit codes for a screen, with the metadata as text chunks.

use std::io::{Cursor, Write};
use std::path::Path;

use ::image::codecs::png::PngEncoder;
use ::image::{ExtendedColorType, ImageEncoder, ImageFormat, ImageReader};
use glam::UVec2;

use super::atomic::replace;
use super::metadata::SOFTWARE;
use super::{Display, EncodeError, Encoding, Image, Metadata, Picture, Window, WriteError};
use crate::spectrum::Spectrum;

/// Bytes of the signature (8) and the header chunk IHDR (4 + 4 + 13 + 4), which an encoder writes first.
const HEAD: usize = 8 + 25;

/// Writes the window of a picture as a PNG file of 8-bit RGB.
///
/// With [`Display::Srgb`] an `sRGB` chunk (perceptual intent) declares the colour space; with [`Display::Exposure`]
/// there is none. Text chunks hold `Software`, `Comment` (the display curve), the [`Metadata`] as `Scene`, `Seed`,
/// `Samples per pixel` and `Render seconds`, and, if the window is not the whole image, `Window`. Text that is not ASCII
/// is stored as UTF-8 in an `iTXt` chunk.
///
/// The same arguments give the same bytes. The file is replaced whole or not at all, as
/// [`write_file`](super::write_file) says.
///
/// # Errors
/// When the path cannot be written, or the parts of the picture contradict each other.
pub fn write_png(
    path: impl AsRef<Path>,
    picture: &Picture,
    display: Display,
    metadata: &Metadata,
) -> Result<(), WriteError> {
    let path = path.as_ref();
    let bytes = picture
        .check()
        .and_then(|()| encode(picture, display, metadata))
        .map_err(|error| WriteError::Picture { path: path.to_owned(), error })?;
    replace(path, |file| file.write_all(&bytes))
}

/// The bytes of a PNG file with these 8-bit codes, three for each pixel, row by row from the top left; without any text.
///
/// # Errors
/// If there are not three codes for each pixel, or no pixel.
pub fn encode_png(size: UVec2, codes: &[u8]) -> Result<Vec<u8>, EncodeError> {
    let pixels = u64::from(size.x) * u64::from(size.y);
    if pixels == 0 || codes.len() as u64 != 3 * pixels {
        let found = codes.len();
        return Err(EncodeError(format!(
            "{found} codes do not make {} x {} pixels",
            size.x, size.y
        )));
    }
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes)
        .write_image(codes, size.x, size.y, ExtendedColorType::Rgb8)
        .map_err(|error| EncodeError(error.to_string()))?;
    Ok(bytes)
}

fn encode(
    picture: &Picture,
    display: Display,
    metadata: &Metadata,
) -> Result<Vec<u8>, EncodeError> {
    let size = picture.window.size();
    let image = encode_png(size, &display.codes(&picture.color))?;

    // The encoder writes neither the sRGB chunk nor text: both may follow directly after the header.
    let (head, body) = image.split_at(HEAD);
    let mut bytes = head.to_vec();
    if display == Display::Srgb {
        let perceptual = [0];
        push_chunk(&mut bytes, b"sRGB", &perceptual);
    }
    for (keyword, text) in texts(picture, display, metadata) {
        push_text(&mut bytes, keyword, &text);
    }
    bytes.extend_from_slice(body);
    Ok(bytes)
}

/// Keywords and texts. `Software` and `Comment` are keywords that the format predefines.
fn texts(picture: &Picture, display: Display, metadata: &Metadata) -> Vec<(&'static str, String)> {
    let mut texts = vec![
        ("Software", SOFTWARE.to_owned()),
        ("Comment", display.description().to_owned()),
        ("Scene", metadata.scene.clone()),
        ("Seed", metadata.seed.to_string()),
        ("Samples per pixel", metadata.samples_per_pixel.to_string()),
        ("Render seconds", metadata.seconds.to_string()),
    ];
    let Picture { resolution, window, .. } = picture;
    if *window != Window::full(*resolution) {
        let (min, size) = (window.min, window.size());
        let text = format!(
            "{}x{}+{}+{} of {}x{}",
            size.x, size.y, min.x, min.y, resolution.x, resolution.y
        );
        texts.push(("Window", text));
    }
    texts
}

/// A `tEXt` chunk, or `iTXt` for what is not ASCII (PNG specification, 11.3.3).
fn push_text(bytes: &mut Vec<u8>, keyword: &str, text: &str) {
    // Zero bytes separate the parts of a chunk and are not allowed in a text.
    let text = text.replace('\0', " ");
    if text.is_ascii() {
        push_chunk(bytes, b"tEXt", format!("{keyword}\0{text}").as_bytes());
    } else {
        // Not compressed; no language and no translated keyword.
        push_chunk(bytes, b"iTXt", format!("{keyword}\0\0\0\0\0{text}").as_bytes());
    }
}

/// Length, type, data, and the CRC of type and data (PNG specification, 5.3).
fn push_chunk(bytes: &mut Vec<u8>, kind: &[u8; 4], data: &[u8]) {
    bytes.extend_from_slice(&(data.len() as u32).to_be_bytes());
    let start = bytes.len();
    bytes.extend_from_slice(kind);
    bytes.extend_from_slice(data);
    let crc = crc32fast::hash(&bytes[start..]);
    bytes.extend_from_slice(&crc.to_be_bytes());
}

/// Decodes a PNG file to codes from 0 to 1.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, String> {
    let image = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png)
        .decode()
        .map_err(|error| format!("it is not a PNG file: {error}"))?
        .into_rgb32f();
    let size = UVec2::new(image.width(), image.height());
    let pixels = image.pixels().map(|pixel| Spectrum::from(pixel.0)).collect();
    Ok(Image { size, pixels, variance: None, degrees_of_freedom: None, encoding: Encoding::Srgb })
}
