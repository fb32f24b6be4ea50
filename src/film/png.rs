//! PNG files: 8 bits for a screen, with notes on how the picture came about.

use std::io::Write;
use std::path::Path;

use glam::UVec2;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

use super::output::replace;
use super::{Display, Metadata, OutputError, Picture, Window};

/// The signature (8 bytes) and the header chunk IHDR (4 + 4 + 13 + 4): what an encoder writes first.
const HEAD: usize = 8 + 25;

/// Writes the window of a picture as a PNG file of 8-bit RGB.
///
/// With [`Display::Srgb`] the file says by an `sRGB` chunk (perceptual) that this is its colour
/// space; with [`Display::Exposure`] it makes no claim. Text chunks say the rest: `Software`,
/// `Comment` (the display curve), `Scene`, `Seed`, `Samples per pixel`, `Render seconds` (what
/// [`Metadata`] holds) and, when the window is not the whole image, `Window`. A text that is not
/// plain ASCII is stored as UTF-8 in an `iTXt` chunk.
///
/// The same arguments give the same bytes. A file of the same name is replaced only when the new
/// one is complete and on the disk. If the process is killed while it writes, a hidden file
/// `.lobe-*.tmp` may remain in the folder.
///
/// # Errors
/// When the path cannot be written, or the parts of the picture do not fit each other.
pub fn write_png(
    path: impl AsRef<Path>,
    picture: &Picture,
    display: Display,
    metadata: &Metadata,
) -> Result<(), OutputError> {
    let path = path.as_ref();
    let bytes = picture
        .check()
        .and_then(|()| encode(picture, display, metadata))
        .map_err(|reason| OutputError::Picture { path: path.to_owned(), reason })?;
    replace(path, |file| file.write_all(&bytes))
}

/// The bytes of a PNG file of codes of three bands, row by row from the top left, without any notes.
///
/// # Errors
/// If there is another number of codes than pixels need, or no pixel.
pub fn encode_png(size: UVec2, codes: &[u8]) -> Result<Vec<u8>, String> {
    let pixels = u64::from(size.x) * u64::from(size.y);
    if pixels == 0 || codes.len() as u64 != 3 * pixels {
        return Err(format!("{} codes do not make {} x {} pixels", codes.len(), size.x, size.y));
    }
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes)
        .write_image(codes, size.x, size.y, ExtendedColorType::Rgb8)
        .map_err(|error| error.to_string())?;
    Ok(bytes)
}

fn encode(picture: &Picture, display: Display, metadata: &Metadata) -> Result<Vec<u8>, String> {
    let size = picture.window.size();
    let image = encode_png(size, &display.codes(&picture.color))?;

    // The encoder knows neither the sRGB chunk nor texts: both may stand right behind the header.
    let (head, body) = image.split_at(HEAD);
    let mut bytes = head.to_vec();
    if display == Display::Srgb {
        let perceptual = [0];
        push_chunk(&mut bytes, b"sRGB", &perceptual);
    }
    for (keyword, text) in notes(picture, display, metadata) {
        push_text(&mut bytes, keyword, &text);
    }
    bytes.extend_from_slice(body);
    Ok(bytes)
}

/// Keywords and texts. `Software` and `Comment` are registered keywords of the format.
fn notes(picture: &Picture, display: Display, metadata: &Metadata) -> Vec<(&'static str, String)> {
    let mut notes = vec![
        ("Software", super::SOFTWARE.to_owned()),
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
        notes.push(("Window", text));
    }
    notes
}

/// A `tEXt` chunk, or `iTXt` for what is not ASCII (PNG specification, 11.3.3).
fn push_text(bytes: &mut Vec<u8>, keyword: &str, text: &str) {
    // Zero bytes separate the parts of a chunk and may not stand in a text.
    let text = text.replace('\0', " ");
    if text.is_ascii() {
        push_chunk(bytes, b"tEXt", format!("{keyword}\0{text}").as_bytes());
    } else {
        // Not compressed, and with no language and no translated keyword.
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
