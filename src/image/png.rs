//! PNG files: 8-bit codes for a screen, with the metadata as text chunks.

use std::io::{BufRead, Seek};
use std::path::Path;

use ::image::codecs::png::{PngDecoder, PngEncoder};
use ::image::{ExtendedColorType, ImageDecoder, ImageEncoder, ImageError, Limits};
use glam::UVec2;

use super::atomic::write_file;
use super::memory::{PIXEL, Refusal, area, check};
use super::metadata::SOFTWARE;
use super::{Display, EncodeError, Image, Metadata, Picture, Window, WriteError, codes};

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
    let bytes = png_bytes(picture, display, metadata)
        .map_err(|error| WriteError::Picture { path: path.to_owned(), error })?;
    write_file(path, &bytes)
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

/// The bytes of the file that [`write_png`] writes.
///
/// # Errors
/// When the parts of the picture contradict each other.
pub fn png_bytes(
    picture: &Picture,
    display: Display,
    metadata: &Metadata,
) -> Result<Vec<u8>, EncodeError> {
    picture.check()?;
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

/// Most bytes that text, colour profiles and other things beside the pixels may take.
const BESIDE: u64 = 64 << 20;

/// Reads what stands before the pixels, which stay within the limit.
fn open<R: BufRead + Seek>(mut source: R, limit: u64) -> Result<PngDecoder<R>, Refusal> {
    // The decoder counts a row together with what stands beside the pixels. A header has the width at byte 16 and the
    // height after it: they are asked whether the limit allows them before the decoder is allowed anything for them.
    let mut head = [0; 24];
    let (mut width, mut height) = (0, 0);
    if source.read_exact(&mut head).is_ok() && head[12..16] == *b"IHDR" {
        let side =
            |at: usize| u32::from_be_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
        (width, height) = (side(16), side(20));
    }
    let size = UVec2::new(width, height);
    check(size, PIXEL * u128::from(area(size)) + 64 * u128::from(width), limit)?;
    source.rewind().map_err(|error| error.to_string())?;
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(BESIDE + 8 * u64::from(width));
    let decoder = PngDecoder::with_limits(source, limits).map_err(unreadable)?;
    let (width, height) = decoder.dimensions();
    let size = UVec2::new(width, height);
    // Codes of the whole image, its pixels, and rows that are being decoded.
    let rows = 64 * u128::from(width);
    let needed = u128::from(decoder.total_bytes()) + PIXEL * u128::from(area(size)) + rows;
    check(size, needed, limit)?;
    Ok(decoder)
}

fn unreadable(error: ImageError) -> String {
    format!("it is not a PNG file: {error}")
}

/// Columns and rows.
pub(super) fn size(source: impl BufRead + Seek, limit: u64) -> Result<UVec2, Refusal> {
    let (width, height) = open(source, limit)?.dimensions();
    Ok(UVec2::new(width, height))
}

/// Decodes a PNG file to codes from 0 to 1.
pub(super) fn decode(source: impl BufRead + Seek, limit: u64) -> Result<Image, Refusal> {
    codes::decode(open(source, limit)?, unreadable)
}
