//! Pictures on disk: everything that was written is read back, by the decoders of `png` and `exr`, and by
//! other programs if they are installed. With LOBE_REQUIRE_EXRHEADER=1 the tools of Debian's
//! package `openexr` are required; Python's OpenEXR and Pillow are used if python3 has them.

mod folders;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use exr::meta::attribute::Chromaticities;
use exr::prelude::{AttributeValue, FlatImage, FlatSamples, Text, Vec2};
use lobe::Spectrum;
use lobe::glam::UVec2;
use lobe::image::{
    Display, Layers, Metadata, Picture, Window, WriteError, check_writable, write_exr, write_png,
};
use lobe::params::Shown;

const SOFTWARE: &str = concat!("lobe ", env!("CARGO_PKG_VERSION"));

/// A folder that is removed at the end of the test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = folders::of_this_run().join(name);
        fs::create_dir(&path).unwrap();
        Self(path)
    }

    fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Values that a careless conversion would change: both zeros, subnormals, the largest, ...
const HARD: [f32; 10] =
    [0.0, -0.0, 1e-45, -1.1e-39, f32::MIN_POSITIVE, 1e30, f32::MAX, -1e30, f32::NAN, f32::INFINITY];

/// A hard value one time in two, and otherwise one with an arbitrary sign, exponent and fraction.
fn value(index: usize) -> f32 {
    let bits = (index as u32).wrapping_mul(0x9E37_79B9) ^ 0x5555_1234;
    if index.is_multiple_of(2) { HARD[index / 2 % HARD.len()] } else { f32::from_bits(bits) }
}

/// A crop, with more lines than any compression puts in a block, and all layers.
fn crop() -> Picture {
    let window = Window { min: UVec2::new(3, 2), max: UVec2::new(16, 41) };
    let n = window.area();
    let triple = |i: usize, salt: usize| [0, 1, 2].map(|c| value(7 * (3 * i + c) + salt));
    Picture {
        resolution: UVec2::new(20, 50),
        window,
        color: (0..n).map(|i| triple(i, 0).into()).collect(),
        variance: Some((0..n).map(|i| triple(i, 4).into()).collect()),
        degrees_of_freedom: Some(3),
        layers: Some(Layers {
            normal: (0..n).map(|i| triple(i, 1).into()).collect(),
            depth: (0..n).map(|i| value(7 * i + 2)).collect(),
            albedo: (0..n).map(|i| triple(i, 3).into()).collect(),
            samples: (0..n).map(|i| value(7 * i + 5).to_bits()).collect(),
        }),
        planes: Vec::new(),
    }
}

/// A whole image without layers, with values over the range that a screen shows.
fn ramp() -> Picture {
    let resolution = UVec2::new(40, 30);
    let color = |i| Spectrum::new(i as f32 / 1000.0 - 0.05, (i as f32 / 400.0).powi(3), 0.2);
    Picture {
        resolution,
        window: Window::full(resolution),
        color: (0..1200).map(color).collect(),
        variance: None,
        degrees_of_freedom: None,
        layers: None,
        planes: Vec::new(),
    }
}

fn metadata() -> Metadata {
    Metadata {
        scene: "the chapter's dragon".to_owned(),
        seed: u64::MAX - 1,
        samples_per_pixel: 4096,
        seconds: 0.1 + 0.2,
        part: None,
    }
}

/// The expected contents of the EXR file, by channel, as bits.
fn channels(picture: &Picture) -> BTreeMap<String, Vec<u32>> {
    let mut expected = BTreeMap::<String, Vec<u32>>::new();
    let mut put_bits = |name: &str, bits: u32| {
        expected.entry(name.to_owned()).or_default().push(bits);
    };
    for pixel in 0..picture.window.area() {
        if let Some(layers) = &picture.layers {
            put_bits("samples.N", layers.samples[pixel]);
        }
        let mut put = |name: &str, value: f32| put_bits(name, value.to_bits());
        if let Some(variance) = &picture.variance {
            let [r, g, b] = variance[pixel].to_array();
            for (name, value) in [("variance.R", r), ("variance.G", g), ("variance.B", b)] {
                put(name, value);
            }
        }
        let [r, g, b] = picture.color[pixel].to_array();
        for (name, value) in [("R", r), ("G", g), ("B", b)] {
            put(name, value);
        }
        if let Some(layers) = &picture.layers {
            let ([r, g, b], n) = (layers.albedo[pixel].to_array(), layers.normal[pixel]);
            for (name, value) in [("albedo.R", r), ("albedo.G", g), ("albedo.B", b)] {
                put(name, value);
            }
            for (name, value) in [("normal.X", n.x), ("normal.Y", n.y), ("normal.Z", n.z)] {
                put(name, value);
            }
            put("depth.Z", layers.depth[pixel]);
        }
    }
    expected
}

/// The formulas, in f64 and from the standard's text.
fn curve(display: Display, linear: f64) -> f64 {
    match display {
        Display::Srgb if linear <= 0.0031308 => 12.92 * linear,
        Display::Srgb => 1.055 * linear.powf(1.0 / 2.4) - 0.055,
        Display::Exposure => 1.0 - (-4.0 * linear).exp(),
        _ => panic!("{display:?} has no formula here"),
    }
}

fn code(display: Display, linear: f32) -> u8 {
    let shown = curve(display, f64::from(linear).max(0.0)).min(1.0);
    (shown * 255.0).round() as u8
}

fn codes(display: Display, picture: &Picture) -> Vec<u8> {
    picture.color.iter().flat_map(|p| p.to_array()).map(|band| code(display, band)).collect()
}

/// Every float at which a code changes, found by bisection in the order of floats, is where the f64
/// formula has it: the float there is on the upper side, the float below it on the lower side.
/// Caught: steps not rounded up; `>` for `>=`; 0.05 for 0.04045; 4.00001 for 4.
#[test]
fn every_code_boundary_is_exact() {
    for display in [Display::Srgb, Display::Exposure] {
        for code in 1..=255 {
            let (mut below, mut above) = (0.0_f32.to_bits(), 4.0_f32.to_bits());
            while above - below > 1 {
                let middle = below.midpoint(above);
                if display.code(f32::from_bits(middle)) >= code {
                    above = middle;
                } else {
                    below = middle;
                }
            }
            let half = f64::from(code) - 0.5;
            let [low, high] =
                [below, above].map(|bits| 255.0 * curve(display, f64::from(f32::from_bits(bits))));
            assert!(low < half && half <= high, "{display:?} {code}: {low} {half} {high}");
        }
    }
}

/// Caught: NaN let through by `!(linear <= 0.0)`.
#[test]
fn display_codes_are_monotone_and_defined_everywhere() {
    for display in [Display::Srgb, Display::Exposure] {
        let mut last = 0;
        for bits in (0..=f32::INFINITY.to_bits()).step_by(997) {
            let linear = f32::from_bits(bits);
            let now = display.code(linear);
            assert!(now >= last, "{display:?} {linear}");
            assert_eq!(now, code(display, linear), "{display:?} {linear}");
            last = now;
        }
        for (linear, expected) in [
            (f32::NAN, 0),
            (-f32::NAN, 0),
            (f32::from_bits(0x7F80_0001), 0),
            (f32::NEG_INFINITY, 0),
            (-1.0, 0),
            (-0.0, 0),
            (1e-45, 0),
            (f32::MAX, 255),
            (f32::INFINITY, 255),
        ] {
            assert_eq!(display.code(linear), expected, "{display:?} {linear}");
        }
        assert_eq!(display.codes(&ramp().color), codes(display, &ramp()));
    }
    assert_eq!(Display::Srgb.code(1.0), 255);
    assert_eq!(Display::Exposure.code(1.0), 250);
}

struct Png {
    size: UVec2,
    codes: Vec<u8>,
    srgb: Option<png::SrgbRenderingIntent>,
    notes: BTreeMap<String, String>,
}

/// Reads a PNG with the decoder's checks on: a chunk with a wrong CRC is ignored.
fn read_png(path: &Path) -> Png {
    let file = std::io::BufReader::new(fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut codes = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut codes).unwrap();
    assert_eq!((frame.color_type, frame.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
    reader.finish().unwrap();
    let info = reader.info();
    let latin = info.uncompressed_latin1_text.iter().map(|t| (t.keyword.clone(), t.text.clone()));
    let utf8 = info.utf8_text.iter().map(|t| (t.keyword.clone(), t.get_text().unwrap()));
    Png {
        size: UVec2::new(frame.width, frame.height),
        codes,
        srgb: info.srgb,
        notes: latin.chain(utf8).collect(),
    }
}

/// Caught: sRGB said of both curves; a CRC without the type; the seed as i64; no note of the crop.
#[test]
fn png_holds_what_was_written() {
    let folder = Folder::new("png");
    let path = folder.file("picture.png");
    for display in [Display::Srgb, Display::Exposure] {
        for picture in [ramp(), crop()] {
            write_png(&path, &picture, display, &metadata()).unwrap();
            let read = read_png(&path);
            assert_eq!(read.size, picture.window.size());
            assert_eq!(read.codes, codes(display, &picture));

            let srgb = (display == Display::Srgb).then_some(png::SrgbRenderingIntent::Perceptual);
            assert_eq!(read.srgb, srgb);
            let note = |keyword: &str| read.notes[keyword].as_str();
            assert_eq!(note("Software"), SOFTWARE);
            assert_eq!(note("Scene"), "the chapter's dragon");
            assert_eq!(note("Seed"), "18446744073709551614");
            assert_eq!(note("Samples per pixel"), "4096");
            assert_eq!(note("Render seconds").parse(), Ok(0.1 + 0.2));
            let formula = if display == Display::Srgb { "IEC 61966-2-1" } else { "1 - exp(-4 L)" };
            assert!(note("Comment").contains(formula), "{}", note("Comment"));
            let window = read.notes.get("Window").map(String::as_str);
            assert_eq!(window, picture.layers.is_some().then_some("13x39+3+2 of 20x50"));
        }
    }
}

/// Caught: UTF-8 in a tEXt chunk; a zero byte inside a text.
#[test]
fn notes_keep_every_alphabet() {
    let folder = Folder::new("alphabet");
    let path = folder.file("picture");
    let scene = "Würfel 龍\0.toml".to_owned();
    let metadata = Metadata { scene: scene.clone(), ..metadata() };
    write_png(&path, &ramp(), Display::Srgb, &metadata).unwrap();
    assert_eq!(read_png(&path).notes["Scene"], "Würfel 龍 .toml");
    write_exr(&path, &ramp(), &metadata).unwrap();
    let found = read_exr(&path).layer_data[0].attributes.other[&Text::from("scene")].clone();
    assert_eq!(found, AttributeValue::Text(Text::from_slice_unchecked(scene.as_bytes())));
}

fn read_exr(path: &Path) -> FlatImage {
    use exr::prelude::{ReadChannels, ReadLayers, read};
    let all = read().no_deep_data().largest_resolution_level().all_channels();
    all.all_layers().all_attributes().pedantic().non_parallel().from_file(path).unwrap()
}

/// Caught: PXR24; albedo in the wrong order; rows and columns of the window exchanged; seconds as
/// f32; another white point.
#[test]
fn exr_holds_what_was_written() {
    let folder = Folder::new("exr");
    let path = folder.file("picture.exr");
    for picture in [ramp(), crop()] {
        write_exr(&path, &picture, &metadata()).unwrap();
        let image = read_exr(&path);
        assert_eq!(image.layer_data.len(), 1);
        let layer = &image.layer_data[0];

        let list = &layer.channel_data.list;
        let found = list.iter().map(|channel| match &channel.sample_data {
            FlatSamples::U32(samples) if channel.name == *"samples.N" => {
                (channel.name.to_string(), samples.clone())
            }
            FlatSamples::F32(samples) if channel.name != *"samples.N" => {
                (channel.name.to_string(), samples.iter().map(|s| s.to_bits()).collect())
            }
            other => panic!("{} is {other:?}", channel.name),
        });
        assert_eq!(found.collect::<BTreeMap<_, _>>(), channels(&picture));
        let first: Vec<_> = list.iter().take(3).map(|c| c.name.to_string()).collect();
        assert_eq!(first, ["B", "G", "R"]);

        let ints = |v: UVec2| Vec2(v.x as i32, v.y as i32);
        let usizes = |v: UVec2| Vec2(v.x as usize, v.y as usize);
        assert_eq!(layer.attributes.layer_position, ints(picture.window.min));
        assert_eq!(layer.size, usizes(picture.window.size()));
        assert_eq!(image.attributes.display_window.position, Vec2(0, 0));
        assert_eq!(image.attributes.display_window.size, usizes(picture.resolution));
        let rec_709 = Chromaticities {
            red: Vec2(0.64, 0.33),
            green: Vec2(0.3, 0.6),
            blue: Vec2(0.15, 0.06),
            white: Vec2(0.3127, 0.329),
        };
        assert_eq!(image.attributes.chromaticities, Some(rec_709));

        assert_eq!(layer.attributes.software_name, Some(Text::from(SOFTWARE)));
        let other = &layer.attributes.other;
        let degrees = picture.degrees_of_freedom.map(|n| AttributeValue::I32(n as i32));
        assert_eq!(other.get(&Text::from("varianceDegreesOfFreedom")), degrees.as_ref());
        assert_eq!(other.len(), if degrees.is_some() { 5 } else { 4 });
        for (name, value) in [
            ("scene", AttributeValue::Text(Text::from("the chapter's dragon"))),
            ("seed", AttributeValue::Text(Text::from("18446744073709551614"))),
            ("samplesPerPixel", AttributeValue::I32(4096)),
            ("renderSeconds", AttributeValue::F64(0.1 + 0.2)),
        ] {
            assert_eq!(other[&Text::from(name)], value);
        }
    }
}

/// Caught: attributes in a hash map's order.
#[test]
fn equal_input_gives_equal_bytes() {
    let folder = Folder::new("equal");
    let path = folder.file("picture");
    let exr = |_| {
        write_exr(&path, &crop(), &metadata()).unwrap();
        fs::read(&path).unwrap()
    };
    let files: Vec<_> = (0..8).map(exr).collect();
    assert!(files.windows(2).all(|pair| pair[0] == pair[1]));
    let png = |_| {
        write_png(&path, &crop(), Display::Srgb, &metadata()).unwrap();
        fs::read(&path).unwrap()
    };
    let files: Vec<_> = (0..8).map(png).collect();
    assert!(files.windows(2).all(|pair| pair[0] == pair[1]));
}

fn message(result: Result<(), WriteError>) -> String {
    result.unwrap_err().to_string()
}

/// Caught: each arm of `Target::resolve` taken away.
#[test]
fn a_path_that_cannot_be_written_is_refused_early_and_late() {
    let folder = Folder::new("refused");
    let plain = folder.file("plain");
    fs::write(&plain, "earlier").unwrap();
    let locked = folder.file("locked.png");
    fs::write(&locked, "earlier").unwrap();
    let mut permissions = fs::metadata(&locked).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&locked, permissions).unwrap();

    let long = folder.file(&"x".repeat(300));
    let (none, under_plain) = (folder.file("none"), plain.clone());
    let no_folder = |at: &Path| format!("there is no folder `{}`; create it first", at.display());
    let mut cases = vec![
        (folder.0.clone(), "it is a folder; give the name of a file in it".to_owned()),
        (none.join("x.png"), no_folder(&none)),
        (under_plain.join("x.png"), no_folder(&under_plain)),
        (locked, "the file is write-protected; allow writing or give another name".to_owned()),
        (PathBuf::new(), "it names no file; give a file name such as picture.png".to_owned()),
    ];
    if cfg!(target_os = "linux") {
        let reason = "File name too long (os error 36); choose a shorter name".to_owned();
        cases.push((long, reason));
        let reason = "it is not an ordinary file; give the name of a new file".to_owned();
        let pipe = folder.file("pipe");
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        cases.push((pipe, reason));
    }
    let before = folder.names();
    for (path, reason) in cases {
        let expected = format!("cannot write `{}`: {reason}", Shown::path(&path));
        assert_eq!(message(check_writable(&path)), expected);
        assert_eq!(message(write_png(&path, &ramp(), Display::Srgb, &metadata())), expected);
        assert_eq!(message(write_exr(&path, &ramp(), &metadata())), expected);
    }
    assert_eq!(folder.names(), before);
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_without_permission_is_refused_early() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new("forbidden");
    let inner = folder.file("inner");
    fs::create_dir(&inner).unwrap();
    fs::set_permissions(&inner, fs::Permissions::from_mode(0o555)).unwrap();
    if fs::write(inner.join("probe"), "").is_ok() {
        println!("SKIPPED: this user may write anywhere");
        return;
    }
    let path = inner.join("x.png");
    let reason = "Permission denied (os error 13); choose a folder that you may write to";
    let expected = format!("cannot write `{}`: {reason}", Shown::path(&path));
    assert_eq!(message(check_writable(&path)), expected);
    assert_eq!(message(write_exr(&path, &ramp(), &metadata())), expected);
}

/// Caught: the probe left behind; the probe made under the final name.
#[test]
fn checking_leaves_nothing_behind() {
    let folder = Folder::new("check");
    check_writable(folder.file("new.png")).unwrap();
    assert!(folder.names().is_empty());
    fs::write(folder.file("old.png"), "earlier").unwrap();
    check_writable(folder.file("old.png")).unwrap();
    assert_eq!(folder.names(), ["old.png"]);
    assert_eq!(fs::read(folder.file("old.png")).unwrap(), b"earlier");
}

/// Caught: each check of `Picture::check` taken away.
#[test]
fn a_picture_that_contradicts_itself_is_refused() {
    fn layers(picture: &mut Picture) -> &mut Layers {
        picture.layers.as_mut().unwrap()
    }
    let folder = Folder::new("contradiction");
    let path = folder.file("x");
    type Break = fn(&mut Picture);
    let cases: [(Break, &str); 10] = [
        (|p| p.window.max.x = 21, "its window reaches beyond the image"),
        (|p| p.window.min.y = 41, "its window holds no pixel"),
        (|p| p.window.min.x = 17, "its window holds no pixel"),
        (|p| p.resolution.x = (1 << 30) - 1, "a file's sides hold at most 1073741822 pixels"),
        (|p| p.color.truncate(5), "its window has 507 pixels, but 5 values of colour"),
        (|p| layers(p).normal.clear(), "its window has 507 pixels, but 0 values of normal"),
        (|p| layers(p).depth.push(1.0), "its window has 507 pixels, but 508 values of depth"),
        (|p| layers(p).albedo.clear(), "its window has 507 pixels, but 0 values of albedo"),
        (|p| layers(p).samples.clear(), "its window has 507 pixels, but 0 values of samples"),
        (|p| p.variance = Some(vec![]), "its window has 507 pixels, but 0 values of variance"),
    ];
    for (break_it, reason) in cases {
        let mut picture = crop();
        break_it(&mut picture);
        let expected = format!("cannot write `{}`: {reason}; mend the picture", path.display());
        assert_eq!(message(write_png(&path, &picture, Display::Srgb, &metadata())), expected);
        assert_eq!(message(write_exr(&path, &picture, &metadata())), expected);
    }
    assert!(folder.names().is_empty());
}

/// exr refuses a side of i32::MAX / 2; the limit comes from there.
#[test]
fn the_last_pixel_of_the_largest_image_can_be_written() {
    let folder = Folder::new("largest");
    let path = folder.file("x");
    let resolution = UVec2::splat((1 << 30) - 2);
    let window = Window { min: resolution - 1, max: resolution };
    let picture = Picture { window, ..Picture::new(resolution, vec![Spectrum::WHITE]) };
    write_exr(&path, &picture, &metadata()).unwrap();
    assert_eq!(read_exr(&path).layer_data[0].size, Vec2(1, 1));
    write_png(&path, &picture, Display::Srgb, &metadata()).unwrap();
    assert_eq!(read_png(&path).codes, [255; 3]);
}

/// A reader that opens the file while it is replaced again and again always finds a whole one.
/// Caught: the final name opened for writing.
#[test]
fn a_reader_never_sees_half_a_file() {
    let folder = Folder::new("half");
    let path = folder.file("x.png");
    let write = |picture: &Picture| {
        write_png(&path, picture, Display::Srgb, &metadata()).unwrap();
        fs::read(&path).unwrap()
    };
    let versions = [write(&ramp()), write(&crop())];
    std::thread::scope(|scope| {
        let writer = scope.spawn(|| {
            for _ in 0..40 {
                write_png(&path, &ramp(), Display::Srgb, &metadata()).unwrap();
                write_png(&path, &crop(), Display::Srgb, &metadata()).unwrap();
            }
        });
        while !writer.is_finished() {
            assert!(versions.contains(&fs::read(&path).unwrap()));
        }
        writer.join().unwrap();
    });
    assert_eq!(folder.names(), ["x.png"]);
}

/// A temporary file left by a killed process with the same id is neither used nor removed.
/// Caught: `File::create` for `create_new`.
#[test]
fn other_temporary_files_are_left_alone() {
    let folder = Folder::new("stale");
    let stale = |count: usize| folder.file(&format!(".lobe-{}-{count}.tmp", std::process::id()));
    for count in 0..1000 {
        fs::write(stale(count), "stale").unwrap();
    }
    write_png(folder.file("x.png"), &ramp(), Display::Srgb, &metadata()).unwrap();
    assert_eq!(read_png(&folder.file("x.png")).size, UVec2::new(40, 30));
    assert!((0..1000).all(|count| fs::read(stale(count)).unwrap() == b"stale"));
}

/// The file behind a link is replaced, not the link, and keeps its permissions.
/// Caught: the link itself replaced; permissions not copied.
#[cfg(unix)]
#[test]
fn links_and_permissions_are_kept() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new("links");
    let (file, link) = (folder.file("file.png"), folder.file("link.png"));
    fs::write(&file, "earlier").unwrap();
    fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
    std::os::unix::fs::symlink("file.png", &link).unwrap();
    write_png(&link, &ramp(), Display::Srgb, &metadata()).unwrap();
    assert_eq!(read_png(&file).size, UVec2::new(40, 30));
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
}

/// The environment variable with the file that the child below writes, when a test starts this program again.
const CHILD: &str = "LOBE_OUTPUT_CHILD";

/// Runs as a child whose files may hold one block of 512 bytes: the write fails halfway, as on a disk
/// that is full. Does nothing when it is not a child.
#[test]
fn child_with_no_space() {
    if let Some(path) = std::env::var_os(CHILD) {
        check_writable(&path).unwrap();
        println!("{}", message(write_exr(&path, &crop(), &metadata())));
    }
}

/// Caught: no removal; the final name opened for writing.
#[cfg(target_os = "linux")]
#[test]
fn a_failed_write_leaves_the_earlier_file_and_nothing_else() {
    let folder = Folder::new("full");
    let path = folder.file("x.exr");
    fs::write(&path, "earlier").unwrap();
    // The shell ignores the signal, so that the write returns an error instead; the child inherits
    // that and the limit. What it says goes into a pipe, which has none.
    let run = "trap '' XFSZ; ulimit -f 1; exec \"$0\" --exact --nocapture child_with_no_space";
    let child = Command::new("sh")
        .args(["-c", run])
        .arg(std::env::current_exe().unwrap())
        .env(CHILD, &path)
        .output()
        .unwrap();
    let expected = format!(
        "cannot write `{}`: File too large (os error 27); free some space or choose another disk",
        path.display()
    );
    let said = String::from_utf8_lossy(&child.stdout);
    assert!(child.status.success() && said.contains(&expected), "{child:?}");
    assert_eq!(folder.names(), ["x.exr"]);
    assert_eq!(fs::read(&path).unwrap(), b"earlier");
}

/// Runs a program and returns its output; `None`, with a note, if it is not installed, unless it is required.
/// Failure is recognised by stderr: exrinfo 3.1.5 exits with an uninitialised variable.
fn tool(name: &str, path: &Path) -> Option<String> {
    let required = std::env::var_os("LOBE_REQUIRE_EXRHEADER").is_some_and(|value| value == "1");
    match Command::new(name).arg(path).output() {
        Ok(output) if output.stderr.is_empty() => Some(String::from_utf8(output.stdout).unwrap()),
        Ok(output) => panic!("{name}: {output:?}"),
        Err(error) if required => panic!("{name} is required: {error}"),
        Err(error) => {
            println!("SKIPPED: no check by {name}: {error}");
            None
        }
    }
}

/// Caught: windows exchanged; seconds as f32; a seed that is not the one given.
#[test]
fn the_openexr_tools_read_the_same() {
    let folder = Folder::new("tools");
    let path = folder.file("x.exr");
    write_exr(&path, &crop(), &metadata()).unwrap();

    if let Some(said) = tool("exrheader", &path) {
        let names: Vec<_> = channels(&crop()).into_keys().collect();
        let found = said.lines().filter_map(|line| {
            let (name, kind) = line.split_once(", 32-bit ")?;
            let samples = name.trim() == "samples.N";
            let expected = if samples { "unsigned integer" } else { "floating-point" };
            kind.starts_with(&format!("{expected}, sampling 1 1")).then_some(name.trim())
        });
        assert_eq!(found.collect::<Vec<_>>(), names);
        for line in [
            "red   (0.64 0.33)",
            "green (0.3 0.6)",
            "blue  (0.15 0.06)",
            "white (0.3127 0.329)",
            "compression (type compression): zip, multi-scanline blocks",
            "dataWindow (type box2i): (3 2) - (15 40)",
            "displayWindow (type box2i): (0 0) - (19 49)",
            "lineOrder (type lineOrder): increasing y",
            "pixelAspectRatio (type float): 1",
            "renderSeconds (type double): 0.3",
            "samplesPerPixel (type int): 4096",
            "scene (type string): \"the chapter's dragon\"",
            "seed (type string): \"18446744073709551614\"",
            &format!("software (type string): \"{SOFTWARE}\""),
        ] {
            assert!(said.lines().any(|found| found.trim() == line), "no `{line}` in\n{said}");
        }
    }
    if let Some(said) = tool("exrinfo", &path) {
        assert!(said.contains("compression: 'zip'"), "{said}");
        assert!(said.contains("[ 3, 2 - 15 40 ] 13 x 39"), "{said}");
    }
}

/// The output of a Python program that needs these modules, or `None`, with a note.
fn python(modules: &str, program: &str, path: &Path) -> Option<String> {
    let run = |program: &str| Command::new("python3").args(["-c", program]).arg(path).output();
    match run(&format!("import {modules}")) {
        Ok(output) if output.status.success() => {}
        _ => {
            println!("SKIPPED: no check by python3 with {modules}");
            return None;
        }
    }
    let output = run(&format!("import sys, {modules}\n{program}")).unwrap();
    assert!(output.status.success(), "{output:?}");
    Some(String::from_utf8(output.stdout).unwrap())
}

/// Caught: PXR24; albedo in the wrong order.
#[test]
fn python_reads_the_same_exr() {
    let folder = Folder::new("python-exr");
    let path = folder.file("x.exr");
    write_exr(&path, &crop(), &metadata()).unwrap();
    let program = "
file = OpenEXR.File(sys.argv[1], separate_channels=True)
for name, channel in file.channels().items():
    print(name, channel.pixels.dtype, *channel.pixels.shape, channel.pixels.tobytes().hex())
";
    if let Some(said) = python("OpenEXR", program, &path) {
        let expected = channels(&crop()).into_iter().map(|(name, bits)| {
            let hex: String =
                bits.iter().flat_map(|b| b.to_le_bytes()).map(|b| format!("{b:02x}")).collect();
            let kind = if name == "samples.N" { "uint32" } else { "float32" };
            format!("{name} {kind} 39 13 {hex}")
        });
        assert_eq!(said.lines().collect::<Vec<_>>(), expected.collect::<Vec<_>>());
    }
}

/// Caught: a CRC without the type.
#[test]
fn python_reads_the_same_png() {
    let folder = Folder::new("python-png");
    let path = folder.file("x.png");
    write_png(&path, &crop(), Display::Srgb, &metadata()).unwrap();
    let program = "
image = PIL.Image.open(sys.argv[1])
print(image.mode, *image.size, image.info['srgb'], image.tobytes().hex())
print(image.info['Seed'], image.info['Window'])
";
    if let Some(said) = python("PIL.Image", program, &path) {
        let hex: String =
            codes(Display::Srgb, &crop()).iter().map(|code| format!("{code:02x}")).collect();
        let seed = "18446744073709551614";
        assert_eq!(said, format!("RGB 13 39 0 {hex}\n{seed} 13x39+3+2 of 20x50\n"));
    }
}
