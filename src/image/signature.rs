//! What a file is by its first bytes, whatever its name says.

use std::io::{BufRead, Read, Seek};

use super::memory::Refusal;

/// Bytes that are looked at.
const MOST: u64 = 16;

/// Most bytes of a file in a message.
const SHOWN: usize = 8;

/// Formats: name with its article, what to do with a file that has another ending, and the first bytes.
const KNOWN: [(&str, &str, &[u8]); 10] = [
    ("a PNG", "name it .png", b"\x89PNG\r\n\x1A\n"),
    ("a JPEG", "name it .jpg", b"\xFF\xD8\xFF"),
    ("an EXR", "name it .exr", b"\x76\x2F\x31\x01"),
    ("a PFM", "name it .pfm", b"PF\n"),
    ("a PFM", "name it .pfm", b"Pf\n"),
    ("a GIF", "save it as PNG", b"GIF8"),
    ("a TIFF", "save it as PNG or EXR", b"II*\0"),
    ("a TIFF", "save it as PNG or EXR", b"MM\0*"),
    ("a Radiance HDR", "save it as EXR", b"#?RADIANCE"),
    ("a Radiance HDR", "save it as EXR", b"#?RGBE"),
];

/// Refuses a file that begins with other bytes than files of the format do, which is named as in [`KNOWN`]. PFM files, whose header is text,
/// are refused only if they are of another known format.
///
/// What the sizes in a header promise has no meaning in a file of another format.
pub fn check(source: &mut (impl BufRead + Seek), format: &str) -> Result<(), Refusal> {
    let mut head = Vec::new();
    source.take(MOST).read_to_end(&mut head).map_err(|error| error.to_string())?;
    source.rewind().map_err(|error| error.to_string())?;
    // A file that ends within the first bytes is incomplete.
    let begins =
        |start: &[u8]| head.starts_with(start) || (!head.is_empty() && start.starts_with(&head));
    if KNOWN.iter().any(|(name, _, start)| *name == format && begins(start)) {
        return Ok(());
    }
    let other = KNOWN.iter().find(|(.., start)| head.starts_with(start));
    let webp = ("a WebP", "save it as PNG");
    let is_webp = head.starts_with(b"RIFF") && head.get(8..12) == Some(b"WEBP");
    if let Some((name, cure)) =
        other.map(|(name, cure, _)| (*name, *cure)).or(is_webp.then_some(webp))
    {
        return Err(format!("it is not {format} file, but {name} file: {cure}").into());
    }
    match (format, &head[..]) {
        ("a PFM", _) => Ok(()),
        (_, []) => Err(format!("it is not {format} file: it is empty").into()),
        _ => {
            let start = head[..head.len().min(SHOWN)].escape_ascii();
            Err(format!("it is not {format} file: it begins with `{start}`").into())
        }
    }
}
