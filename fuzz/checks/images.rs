//! What holds for any bytes that are read as an image: an error of one line that names the file, or sound pixels that stay
//! within the limit.

use lobe::image::Image;

/// Memory that an image may take, in bytes.
const LIMIT: u64 = 64 << 20;

pub fn exr(bytes: &[u8]) {
    read("fuzz.exr", bytes);
}

pub fn jpeg(bytes: &[u8]) {
    read("fuzz.jpg", bytes);
}

pub fn pfm(bytes: &[u8]) {
    read("fuzz.pfm", bytes);
}

/// As they are, and with checksums made right, without which hardly any changed file would be looked into.
pub fn png(bytes: &[u8]) {
    read("fuzz.png", bytes);
    read("fuzz.png", &with_checksums(bytes));
}

fn read(name: &str, bytes: &[u8]) {
    match Image::parse(name, bytes, LIMIT) {
        Ok(image) => {
            let [width, height] = image.size.to_array().map(u64::from);
            assert!(width > 0 && height > 0);
            assert_eq!(image.pixels.len() as u64, width * height);
            let variance = image.variance.as_ref();
            assert!(variance.is_none_or(|variance| variance.len() == image.pixels.len()));
            let planes = if variance.is_some() { 2 } else { 1 };
            assert!(planes * size_of_val(&image.pixels[..]) as u64 <= LIMIT);
        }
        Err(error) => {
            let message = error.to_string();
            let start = format!("cannot read `{name}`: ");
            assert!(message.starts_with(&start) && !message.contains('\n'), "{message}");
        }
    }
}

/// A PNG file, whose chunks are length, type, data and checksum.
fn with_checksums(bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let mut start = 8;
    while let Some(length) = bytes.get(start..).and_then(|rest| rest.first_chunk::<4>()) {
        let end = (start + 8).saturating_add(u32::from_be_bytes(*length) as usize);
        if bytes.len() < end.saturating_add(4) {
            break;
        }
        let checksum = crc32fast::hash(&bytes[start + 4..end]);
        bytes[end..end + 4].copy_from_slice(&checksum.to_be_bytes());
        start = end + 4;
    }
    bytes
}
