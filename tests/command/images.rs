//! Images that are made to take all memory or all time, under a limit that the operating system enforces.

use std::fs::{self, File};

use crate::exr_file::ExrFile;
use crate::folder::{Folder, value};

const RGB: [&str; 3] = ["B", "G", "R"];

/// Runs the command with at most 512 MiB of address space. Asserts what it says.
#[cfg(target_os = "linux")]
#[track_caller]
fn fails_within(folder: &Folder, arguments: &str, message: &str) {
    let output = folder.limited("ulimit -v 524288", arguments).output().unwrap();
    assert_eq!(String::from_utf8(output.stderr).unwrap(), format!("error: {message}\n"));
    assert_eq!(output.status.code(), Some(1));
}

/// A PNG file of zeros, with one bit for each pixel.
fn png(folder: &Folder, name: &str, side: u32) {
    let mut encoder = png::Encoder::new(File::create(folder.0.join(name)).unwrap(), side, side);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::One);
    let zeros = vec![0; side.div_ceil(8) as usize * side as usize];
    encoder.write_header().unwrap().write_image_data(&zeros).unwrap();
}

/// An EXR file of zeros by ZIP. All blocks have the same data, which another file is asked for.
fn exr(folder: &Folder, name: &str, side: i32) {
    use exr::prelude::{Blocks, Compression, Encoding, Image, Layer, LineOrder, WritableImage};
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let black = exr::prelude::SpecificChannels::rgb(|_| (0.0_f32, 0.0_f32, 0.0_f32));
    let one = Layer::new((side as usize, 16), Default::default(), encoding, black);
    let path = folder.0.join(name);
    Image::from_layer(one).write().non_parallel().to_file(&path).unwrap();
    let bytes = fs::read(&path).unwrap();
    // Behind its row, 8 bytes before its data, stands their number.
    let starts = |&start: &usize| {
        let length = i32::from_le_bytes(*bytes[start - 4..].first_chunk().unwrap());
        bytes[start - 8..start - 4] == [0; 4] && length as usize == bytes.len() - start
    };
    let start = (8..bytes.len()).find(starts).unwrap();
    let file = ExrFile { channels: &RGB, size: [side, side], compression: 3 };
    let rows = (0..side).step_by(16);
    fs::write(&path, file.with_blocks(rows.map(|row| (row, &bytes[start..])))).unwrap();
}

/// Small files took 10 GB. Seen to fail with headers believed: aborted, for a lack of memory.
#[test]
#[cfg(target_os = "linux")]
fn bombs_are_refused() {
    let folder = Folder::new("bombs");
    png(&folder, "large.png", 20_000);
    png(&folder, "fits.png", 8_000);
    exr(&folder, "large.exr", 20_000);
    exr(&folder, "fits.exr", 8_000);
    let claim = ExrFile { channels: &RGB, size: [1_000_000, 1_000_000], compression: 3 };
    fs::write(folder.0.join("claim.exr"), claim.header()).unwrap();
    for name in ["large.png", "fits.png", "large.exr", "fits.exr", "claim.exr"] {
        assert!(fs::metadata(folder.0.join(name)).unwrap().len() < 5 << 20, "{name}");
    }
    let limit = "above the limit of 4096 MiB; raise it with --max-image-mb";
    for (name, reason) in [
        ("large.png", format!("20000 x 20000 pixels take 6105 MiB of memory, {limit}")),
        ("large.exr", format!("20000 x 20000 pixels take 6109 MiB of memory, {limit}")),
        ("claim.exr", format!("1000000 x 1000000 pixels take 15258790 MiB of memory, {limit}")),
        ("fits.png", "977 MiB of memory are not available".into()),
        ("fits.exr", "977 MiB of memory are not available".into()),
    ] {
        let message = format!("cannot read `{name}`: {reason}");
        fails_within(&folder, &format!("compare {name} {name}"), &message);
    }
    // A limit of one's own.
    let message = "cannot read `fits.png`: 8000 x 8000 pixels take 978 MiB of memory, above the limit of 100 MiB; \
                   raise it with --max-image-mb";
    folder.fails("compare fits.png fits.png --max-image-mb 100", message);
}

/// Neither image is decoded unless their sizes agree. Seen to fail with both decoded first: the first image cannot be
/// read.
#[test]
fn sizes_are_compared_first() {
    let folder = Folder::new("sizes");
    for (name, size) in [("a.exr", [4, 3]), ("b.exr", [4, 4])] {
        let file = ExrFile { channels: &RGB, size, compression: 0 };
        fs::write(folder.0.join(name), file.header()).unwrap();
    }
    let different = "the images have 4 x 3 and 4 x 4 pixels: they have to be of one size";
    folder.fails("compare a.exr b.exr", different);
    let different =
        "`a.exr`: the images have 4 x 3 and 20 x 10 pixels: they have to be of one size";
    folder.fails("chart s.toml --add x=a.exr,1", different);
    let incomplete = "cannot read `a.exr`: it is incomplete: 0 of 3 blocks of pixels";
    folder.fails("compare a.exr a.exr", incomplete);
    let limit = "cannot read `large.exr`: 4096 x 4096 pixels take 257 MiB of memory, above the limit of 256 MiB; \
                 raise it with --max-image-mb";
    let file = ExrFile { channels: &RGB, size: [4096, 4096], compression: 0 };
    fs::write(folder.0.join("large.exr"), file.header()).unwrap();
    folder.fails("chart s.toml --max-image-mb 256 --add x=large.exr,1", limit);
    let complete = ExrFile { channels: &RGB, size: [4, 3], compression: 0 }.of_ones();
    fs::write(folder.0.join("c.exr"), complete).unwrap();
    let summary = folder.prints("compare c.exr c.exr --max-image-mb 1");
    assert_eq!(value(&summary, "mse"), "0.000000e0");
}

/// Seen to fail with the pipe opened: it waits for a writer.
#[test]
#[cfg(unix)]
fn pipes_and_devices_are_refused() {
    let folder = Folder::new("pipes");
    let pipe = folder.0.join("pipe.png");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    std::os::unix::fs::symlink("/dev/zero", folder.0.join("zero.pfm")).unwrap();
    for name in ["pipe.png", "zero.pfm"] {
        let reason = "it is not an ordinary file; copy its contents to one first";
        let message = format!("cannot read `{name}`: {reason}");
        folder.fails(&format!("compare {name} {name}"), &message);
        folder.fails(&format!("chart s.toml --add x={name},1"), &message);
    }
    let missing = "cannot read `no.exr`: there is no such file";
    folder.fails("compare no.exr no.exr", missing);
}

/// A header of 60,000,000 columns, which the decoder would allow 8 bytes each for anything else in the file. Seen to fail with
/// the size asked after the decoder's own reading.
#[test]
fn a_wide_header_is_refused_first() {
    let folder = Folder::new("wide");
    let mut head = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR".to_vec();
    head.extend(60_000_000_u32.to_be_bytes());
    head.extend([0, 0, 0, 1, 1, 0, 0, 0, 0]);
    std::fs::write(folder.0.join("w.png"), head).unwrap();
    folder.fails(
        "compare w.png w.png --max-image-mb 1",
        "cannot read `w.png`: 60000000 x 1 pixels take 4578 MiB of memory, above the limit of 1 MiB; raise it with --max-image-mb",
    );
}

/// Two images that can be read, and not compared in the memory that is left. Seen to abort without the check.
#[cfg(target_os = "linux")]
#[test]
fn comparing_within_memory() {
    let folder = Folder::new("compare-memory");
    png(&folder, "a.png", 1500);
    let message = "comparing 1500 x 1500 pixels takes 550 MiB of memory, which are not available";
    fails_within(&folder, "compare a.png a.png", message);
}
