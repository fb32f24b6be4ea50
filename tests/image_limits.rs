//! Images that are refused: by the memory that they would take, because something is missing, or for what their path names.

mod exr_file;
mod jpeg_file;

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use exr_file::ExrFile;
use jpeg_file::JpegFile;
use lobe::image::{Image, ImageFile};

const RGB: [&str; 3] = ["B", "G", "R"];
const SMALL: ExrFile = ExrFile { channels: &RGB, size: [4, 3], compression: 0 };

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("image-limits-{name}"))
}

/// The reason why the bytes of a file are refused.
#[track_caller]
fn reason(name: &str, bytes: &[u8], limit: u64) -> String {
    let message = Image::parse(name, bytes, limit).unwrap_err().to_string();
    message.strip_prefix(&format!("cannot read `{name}`: ")).unwrap().to_owned()
}

/// Seen to fail with sizes of up to 32 bits: the reason was the number of bytes, and 2 x 4294967295 pixels are a picture whose
/// map has more rows than 32 bits count.
#[test]
fn sides_of_pfm_files_have_31_bits() {
    for sides in ["2147483648 2147483648", "2147549185 2147418113", "1 4294967295", "4294967297 1"]
    {
        let file = format!("Pf\n{sides}\n-1\n\0\0\0\0");
        let expected =
            format!("its size is `{sides}`, expected columns and rows, both from 1 to 2147483647");
        assert_eq!(reason("a.pfm", file.as_bytes(), 1 << 20), expected);
    }
    let largest = b"PF\n2147483647 2147483647\n-1\n";
    let expected = "2147483647 x 2147483647 pixels need 55340232169589047308 bytes, not 0";
    assert_eq!(reason("a.pfm", largest, u64::MAX), expected);
    assert_eq!(reason("a.pfm", &[b' '; 300], u64::MAX), "it ends within its header");
}

/// A file of 377 bytes made the process abort. Seen to fail with headers believed: the first reason was that of
/// missing blocks.
#[test]
fn what_a_header_promises_is_within_the_limit() {
    let file = ExrFile { size: [1_000_000, 1_000_000], ..SMALL }.header();
    let expected =
        "1000000 x 1000000 pixels take 15258790 MiB of memory, above the limit of 4096 MiB";
    assert_eq!(reason("a.exr", &file, Image::DEFAULT_LIMIT), expected);
    let expected = "it is incomplete: 0 of 1000000 blocks of pixels";
    assert_eq!(reason("a.exr", &file, u64::MAX), expected);
    // Variance counts as much again.
    let channels = ["B", "G", "R", "variance.B", "variance.G", "variance.R"];
    let file = ExrFile { channels: &channels, size: [1024, 1024], compression: 0 }.header();
    let expected = "1024 x 1024 pixels take 33 MiB of memory, above the limit of 32 MiB";
    assert_eq!(reason("a.exr", &file, 32 << 20), expected);
    // 12 bytes for a pixel in the file, 16 in memory; one row is read at a time.
    let file = [b"PF\n1024 512\n-1\n", &[0; 12 * 1024 * 512][..]].concat();
    let least = (16 * 1024 * 512) + 12 * 1024;
    assert_eq!(Image::parse("a.pfm", &file, least).unwrap().pixels.len(), 1024 * 512);
    let expected = "1024 x 512 pixels take 9 MiB of memory, above the limit of 8 MiB";
    assert_eq!(reason("a.pfm", &file, least - 1), expected);
}

/// Codes, pixels and rows of a PNG file count. Seen to fail with codes left out.
#[test]
fn codes_of_png_files_count() {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 1024, 1024);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().unwrap().write_image_data(&[0; 1 << 20]).unwrap();
    let least = (16 + 1) * (1 << 20) + 64 * 1024;
    assert_eq!(Image::parse("a.png", &file, least).unwrap().pixels.len(), 1 << 20);
    let expected = "1024 x 1024 pixels take 18 MiB of memory, above the limit of 17 MiB";
    assert_eq!(reason("a.png", &file, least - 1), expected);
}

const JPEG: JpegFile<'static> = JpegFile {
    size: [40, 30],
    components: &[(90, 1)],
    is_progressive: false,
    restart: 0,
    adobe: None,
};

/// The file, its coefficients, codes and pixels of a JPEG file count. Seen to fail with the file or its codes left out, and with
/// coefficients of three bands.
#[test]
fn codes_and_coefficients_of_jpeg_files_count() {
    let colors = [(90, 2), (100, 1), (100, 1)];
    for (components, bands) in [(JPEG.components, 1), (&colors[..], 3)] {
        let file = JpegFile { size: [1024, 512], components, ..JPEG }.bytes();
        let least = (16 + 8 + bands) * (1 << 19) + file.len() as u64;
        assert_eq!(Image::parse("a.jpg", &file, least).unwrap().pixels.len(), 1 << 19);
        let [takes, limit] = [least.div_ceil(1 << 20), least >> 20];
        let expected =
            format!("1024 x 512 pixels take {takes} MiB of memory, above the limit of {limit} MiB");
        assert_eq!(reason("a.jpg", &file, least - 1), expected);
    }
    // Some hundred bytes that promise the largest picture.
    let file = JpegFile { size: [65535; 2], components: &colors, ..JPEG }.head();
    let expected = "65535 x 65535 pixels take 110589 MiB of memory, above the limit of 4096 MiB";
    assert_eq!(reason("a.jpg", &file, Image::DEFAULT_LIMIT), expected);
}

/// What is missing was grey. Wherever the file ends, it is refused; what follows its end marker does not matter, nor does a picture
/// within a segment. Seen to fail with files taken as they are, with markers within segments, and with the stuffed zero taken for a
/// marker.
#[test]
fn incomplete_jpeg_files_are_refused() {
    // Ones in the scan, so that zeros are stuffed.
    let colors = [(0, 1), (255, 1), (255, 1)];
    for jpeg in [
        JPEG,
        JpegFile { components: &colors, ..JPEG },
        JpegFile { is_progressive: true, restart: 2, ..JPEG },
    ] {
        let (whole, head) = (jpeg.bytes(), jpeg.head().len());
        for end in head..whole.len() {
            let expected = "it is incomplete: it has no end marker";
            assert_eq!(
                reason("a.jpg", &whole[..end], 1 << 20),
                expected,
                "{end} of {}",
                whole.len()
            );
        }
        for end in 0..head {
            let reason = reason("a.jpg", &whole[..end], 1 << 20);
            assert!(
                reason.starts_with("it is not a JPEG file: ")
                    || reason.starts_with("it is incomplete: "),
                "{end}: {reason}"
            );
        }
        // A thumbnail in a segment has an end marker of its own.
        let thumbnail = JPEG.bytes();
        let segment =
            [&[0xFF, 0xE1][..], &(thumbnail.len() as u16 + 2).to_be_bytes(), &thumbnail].concat();
        let with_thumbnail = [&whole[..2], &segment, &whole[2..]].concat();
        let image = Image::parse("a.jpg", &with_thumbnail, 1 << 20).unwrap();
        assert_eq!(image, Image::parse("a.jpg", &whole, 1 << 20).unwrap());
        let cut = &with_thumbnail[..with_thumbnail.len() - 1];
        assert_eq!(reason("a.jpg", cut, 1 << 20), "it is incomplete: it has no end marker");
        let padded = [&whole[..], &[0; 100]].concat();
        assert_eq!(image, Image::parse("a.jpg", &padded, 1 << 20).unwrap());
    }
}

/// A header of many attributes takes far more memory than it has bytes. Seen to fail with headers of any length.
#[test]
fn headers_are_within_the_limit() {
    let mut file = ExrFile { size: [1, 1], ..SMALL }.header();
    file.pop();
    for index in 0..40_000 {
        file.extend(format!("{index:x}\0t\0\0\0\0\0").bytes());
    }
    let expected = "its header takes more memory than the limit of 16 MiB";
    assert_eq!(reason("a.exr", &file, 16 << 20), expected);
    file.push(0);
    let expected = "it is incomplete: 0 of 1 blocks of pixels";
    assert_eq!(reason("a.exr", &file, 256 << 20), expected);
}

/// A block that decompresses to more than its pixels, 64 times as many bytes for runs, is refused before. Seen to fail with
/// blocks not counted: they were decompressed.
#[test]
fn blocks_are_within_the_limit() {
    let file = ExrFile { size: [100_000, 1], compression: 1, ..SMALL };
    let runs = [127, 0].repeat(500_000);
    let file = file.with_blocks([(0, &runs[..])].into_iter());
    let expected = "100000 x 1 pixels take 133 MiB of memory, above the limit of 16 MiB";
    assert_eq!(reason("a.exr", &file, 16 << 20), expected);
}

/// Blocks that are missing were black. Seen to fail with blocks not counted, and with blocks counted that the table names twice.
#[test]
fn incomplete_exr_files_are_refused() {
    let whole = SMALL.of_ones();
    let image = Image::parse("a.exr", &whole, 1 << 20).unwrap();
    assert!(image.pixels.iter().all(|pixel| pixel.to_array() == [1.0; 3]));

    let table = SMALL.header().len();
    let with_position = |block: usize, position: u64| {
        let mut file = whole.clone();
        file[table + 8 * block..][..8].copy_from_slice(&position.to_le_bytes());
        file
    };
    let first = u64::from_le_bytes(*whole[table..].first_chunk().unwrap());
    let incomplete = "it is incomplete: 2 of 3 blocks of pixels";
    // Never written, named twice, outside the file, cut off.
    assert_eq!(reason("a.exr", &with_position(1, 0), 1 << 20), incomplete);
    assert_eq!(reason("a.exr", &with_position(1, first), 1 << 20), incomplete);
    assert_eq!(reason("a.exr", &with_position(1, u64::MAX), 1 << 20), incomplete);
    assert_eq!(reason("a.exr", &whole[..whole.len() - 1], 1 << 20), incomplete);
    let expected = "it is incomplete: 0 of 3 blocks of pixels";
    assert_eq!(reason("a.exr", &whole[..table + 23], 1 << 20), expected);
    let expected = "it is not a readable EXR file: a block of pixels is out of place";
    assert_eq!(reason("a.exr", &with_position(1, first + 4), 1 << 20), expected);
}

/// Grey and colours with the same codes have the same values, code / 255. Seen to fail with grey converted by weights of
/// luminance: 51 gave 0.20000002.
#[test]
fn grey_codes_are_exact() {
    let codes: Vec<u8> = (0..=255).collect();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 256, 1);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().unwrap().write_image_data(&codes).unwrap();
    let image = Image::parse("a.png", &file, 1 << 20).unwrap();
    for (code, pixel) in codes.into_iter().zip(image.pixels) {
        assert_eq!(pixel.to_array(), [f32::from(code) / 255.0; 3]);
    }
}

/// Sizes are known before pixels are looked at. Seen to fail with blocks counted when the header is read.
#[test]
fn headers_are_read_alone() {
    let file = path("header.exr");
    fs::write(&file, SMALL.header()).unwrap();
    let opened = ImageFile::open(&file, 1 << 20).unwrap();
    assert_eq!(opened.size().to_array(), [4, 3]);
    let message = opened.decode().unwrap_err().to_string();
    assert!(message.ends_with("it is incomplete: 0 of 3 blocks of pixels"), "{message}");
}

/// Seen to fail with the file read first: 5 GiB of zeros. The file has no blocks on the disk.
#[test]
fn files_above_the_limit_are_not_read() {
    let file = path("large.exr");
    File::create(&file).unwrap().set_len(5 << 30).unwrap();
    let message = Image::read(&file).unwrap_err().to_string();
    fs::remove_file(&file).unwrap();
    assert!(message.ends_with("the file has 5120 MiB, above the limit of 4096 MiB"), "{message}");
}

/// Seen to fail with `fs::read`: a pipe waits for a writer, zeros of a device fill the memory, and the rest were numbers of the
/// operating system.
#[test]
#[cfg(unix)]
fn only_ordinary_files_are_read() {
    let folder = path("unusual");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("folder.exr")).unwrap();
    let pipe = folder.join("pipe.png");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    std::os::unix::fs::symlink("/dev/zero", folder.join("device.pfm")).unwrap();
    std::os::unix::fs::symlink("no such file", folder.join("link.pfm")).unwrap();
    // Its path may have a hundred bytes only.
    let short = PathBuf::from(format!("/tmp/lobe-{}.png", std::process::id()));
    let socket = std::os::unix::net::UnixListener::bind(&short).unwrap();
    let unusual = "it is not an ordinary file; copy its contents to one first";
    for (file, reason) in [
        (pipe, unusual),
        (folder.join("device.pfm"), unusual),
        (short.clone(), unusual),
        (folder.join("no.jpeg"), "there is no such file"),
        (folder.join("folder.exr"), "it is a folder; give the name of a file in it"),
        (folder.join("missing.exr"), "there is no such file"),
        (folder.join("link.pfm"), "there is no such file"),
    ] {
        let expected = format!("cannot read `{}`: {reason}", file.display());
        assert_eq!(Image::read(&file).unwrap_err().to_string(), expected);
    }
    drop(socket);
    fs::remove_file(short).unwrap();
}
