//! Reading pictures, and the inverse of the display curves. Files written by the crate are read back bit for bit.
//! tests/output.rs compares them with other programs.

mod folders;
mod jpeg_file;

use std::fs;
use std::path::PathBuf;

use jpeg_file::JpegFile;
use lobe::Spectrum;
use lobe::glam::UVec2;
use lobe::image::{
    Display, Encoding, Image, Metadata, Picture, Window, write_exr, write_pfm, write_png,
};

fn path(name: &str) -> PathBuf {
    folders::of_this_run().join(name)
}

/// A crop with both zeros, subnormals, extremes, and values of every size between.
fn picture() -> Picture {
    let value = |i: u32| match i % 9 {
        0 => -0.0,
        1 => 1e-45,
        2 => f32::MAX,
        3 => f32::INFINITY,
        _ => (i as f32 - 40.0) * 10_f32.powi((i % 11) as i32 - 5),
    };
    let window = Window { min: UVec2::new(3, 2), max: UVec2::new(8, 9) };
    let pixels =
        |salt| (0..35).map(move |i| [0, 1, 2].map(|c: u32| value(3 * i + c + salt)).into());
    Picture {
        resolution: UVec2::new(20, 50),
        window,
        color: pixels(0).collect(),
        variance: Some(pixels(5).collect()),
        degrees_of_freedom: Some(7),
        layers: None,
        planes: Vec::new(),
    }
}

fn bits(pixels: &[Spectrum]) -> Vec<u32> {
    pixels.iter().flat_map(|pixel| pixel.to_array()).map(f32::to_bits).collect()
}

/// Caught: PFM rows from the top down; big-endian numbers; bands exchanged; a band of the variance read twice; a PFM
/// picture that is not checked; degrees of freedom not read.
#[test]
fn linear_formats_come_back_bit_for_bit() {
    let picture = picture();
    let (exr, pfm) = (path("x.exr"), path("x.PFM"));
    write_exr(&exr, &picture, &Metadata::default()).unwrap();
    write_pfm(&pfm, &picture).unwrap();
    for (path, variance, degrees) in
        [(&exr, picture.variance.as_ref(), Some(7)), (&pfm, None, None)]
    {
        let image = Image::read(path).unwrap();
        assert_eq!((image.size, image.encoding), (UVec2::new(5, 7), Encoding::Linear));
        assert_eq!(bits(&image.pixels), bits(&picture.color), "{path:?}");
        assert_eq!(image.degrees_of_freedom, degrees, "{path:?}");
        let found = image.variance.as_deref().map(bits);
        assert_eq!(found, variance.map(|variance| bits(variance)), "{path:?}");
    }
    let unknown = Picture { degrees_of_freedom: None, ..picture.clone() };
    write_exr(&exr, &unknown, &Metadata::default()).unwrap();
    assert_eq!(Image::read(&exr).unwrap().degrees_of_freedom, None);
    let refused = Picture { color: Vec::new(), ..picture };
    let message = write_pfm(&pfm, &refused).unwrap_err().to_string();
    assert!(message.contains("its window has 35 pixels, but 0 values of colour"), "{message}");
}

/// Caught: the largest code taken for 256; columns and rows exchanged.
#[test]
fn png_comes_back_as_its_codes() {
    let png = path("x.png");
    let picture = picture();
    write_png(&png, &picture, Display::Exposure, &Metadata::default()).unwrap();
    let image = Image::read(&png).unwrap();
    assert_eq!((image.size, image.encoding), (UVec2::new(5, 7), Encoding::Srgb));
    let codes: Vec<u8> = image
        .pixels
        .iter()
        .flat_map(|pixel| pixel.to_array())
        .map(|band| (255.0 * band).round() as u8)
        .collect();
    assert_eq!(codes, Display::Exposure.codes(&picture.color));
    assert_eq!(image.pixels[0].to_array()[2], 1.0);
}

/// The inverse gives each of the 256 codes back, and agrees with the curve as IEC 61966-2-1 prints it.
/// Caught: 0.05 for 0.04045; 2.2 for 2.4; 12.9 for 12.92; a factor 4.01 in the exposure.
#[test]
fn decoding_is_exact_at_all_codes() {
    let srgb = |linear: f64| match linear <= 0.0031308 {
        true => 12.92 * linear,
        false => 1.055 * linear.powf(1.0 / 2.4) - 0.055,
    };
    let exposure = |linear: f64| 1.0 - (-4.0 * linear).exp();
    for code in 0..=255 {
        let encoded = f64::from(code) / 255.0;
        for display in [Display::Srgb, Display::Exposure] {
            let linear = display.decode(encoded);
            assert_eq!(display.code(linear as f32), code, "{display:?}");
            let again = if display == Display::Srgb { srgb(linear) } else { exposure(linear) };
            assert!((again - encoded).abs() < 1e-15 + 1e-15 * encoded, "{display:?} {code}");
        }
    }
}

/// Grey is read as it is, luma and chroma by the equations of JFIF (Rec. 601), and of Adobe's files with four components, ink is
/// absent light. One by one, in units of several blocks, progressive, and with restarts. Seen to fail with bands exchanged.
#[test]
fn jpeg_has_codes_in_all_its_kinds() {
    let rgb = |y: f64, cb: f64, cr: f64| {
        let (cb, cr) = (cb - 128.0, cr - 128.0);
        [y + 1.402 * cr, y - 0.344136 * cb - 0.714136 * cr, y + 1.772 * cb]
    };
    type Case<'a> = (&'a [(u8, u8)], Option<u8>, [f64; 3]);
    let cases: [Case; 6] = [
        (&[(77, 1)], None, [77.0; 3]),
        (&[(200, 2)], None, [200.0; 3]),
        (&[(120, 1), (100, 1), (150, 1)], None, rgb(120.0, 100.0, 150.0)),
        (&[(120, 2), (160, 1), (90, 1)], Some(1), rgb(120.0, 160.0, 90.0)),
        (&[(10, 1), (128, 1), (250, 1)], Some(0), [10.0, 128.0, 250.0]),
        (&[(255, 1), (128, 1), (51, 1), (255, 1)], Some(0), [255.0, 128.0, 51.0]),
    ];
    let file = path("x.JPG");
    for (components, adobe, expected) in cases {
        for size in [[8, 8], [1, 1], [17, 9], [3, 40]] {
            for (is_progressive, restart) in [(false, 0), (true, 0), (false, 1), (true, 2)] {
                let jpeg = JpegFile { size, components, is_progressive, restart, adobe };
                fs::write(&file, jpeg.bytes()).unwrap();
                let image = Image::read(&file).unwrap_or_else(|error| {
                    panic!("{components:?} {size:?} {is_progressive} {restart}: {error}")
                });
                assert_eq!(image.size, UVec2::from(size.map(u32::from)));
                assert_eq!((image.encoding, &image.variance), (Encoding::Srgb, &None));
                for pixel in image.pixels {
                    let codes = pixel.to_array().map(|band| f64::from(band) * 255.0);
                    let is_near = codes.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1.51);
                    assert!(
                        is_near,
                        "{components:?} {size:?} {is_progressive} {restart}: {codes:?}, expected {expected:?}"
                    );
                    assert!(codes.iter().all(|code| (code - code.round()).abs() < 1e-4));
                }
            }
        }
    }
}

/// A picture of another program, in which every pixel differs: rows from the top, columns from the left. Seen to fail with bands
/// exchanged.
#[test]
fn jpeg_of_another_encoder() {
    let (width, height) = (37_u32, 21_u32);
    let code = |x: u32, y: u32| [5 * x + 20, 8 * y + 30, 2 * x + 3 * y].map(|code| code as u8);
    let codes: Vec<u8> =
        (0..height).flat_map(|y| (0..width).flat_map(move |x| code(x, y))).collect();
    let mut bytes = Vec::new();
    ::image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 100)
        .encode(&codes, width, height, ::image::ExtendedColorType::Rgb8)
        .unwrap();
    let image = Image::parse("a.jpeg", &bytes, 1 << 20).unwrap();
    assert_eq!(image.size, UVec2::new(width, height));
    for (index, (pixel, codes)) in image.pixels.iter().zip(codes.chunks(3)).enumerate() {
        let found = pixel.to_array().map(|band| (255.0 * band).round() as i32);
        let is_near = found.iter().zip(codes).all(|(a, b)| (a - i32::from(*b)).abs() <= 4);
        assert!(is_near, "pixel {index}: {found:?}, expected {codes:?}");
    }
}

/// Other programs write one band, and big-endian numbers. Caught: the byte order exchanged.
#[test]
fn pfm_of_other_programs() {
    let file = path("gray.pfm");
    let numbers = [1.0_f32, 2.0, 3.0, 4.0].into_iter().flat_map(f32::to_be_bytes);
    fs::write(&file, b"Pf\n2 2\n1.0\n".iter().copied().chain(numbers).collect::<Vec<_>>()).unwrap();
    let image = Image::read(&file).unwrap();
    assert_eq!(image.pixels, [3.0, 4.0, 1.0, 2.0].map(Spectrum::splat));
}

/// A size was read from JPEG and GIF files that were named .png: 15353553688432 MiB. Caught: a product of the sides that leaves 64
/// bits; a side of 0; any magic word; colours not looked for; files of other formats handed to the decoders.
#[test]
fn what_is_no_image_is_refused() {
    const JFIF: &[u8] = b"\xFF\xD8\xFF\xE0\0\x10JFIF";
    let cases: [(&str, &[u8], &str); 22] = [
        ("bad.pfm", b"P6\n2 2\n255\n", "it is not a PFM file: it begins with `P6`, not PF or Pf"),
        ("bad.pfm", b"PF\n2 ", "it ends within its header"),
        (
            "bad.pfm",
            b"PF\n0 2\n-1\n",
            "its size is `0 2`, expected columns and rows, both from 1 to 2147483647",
        ),
        ("bad.pfm", b"PF\n2 2\nlow\n", "its scale is `low`, expected a number"),
        ("bad.pfm", b"PF\n2 1\n-1\nshort", "2 x 1 pixels need 24 bytes, not 5"),
        (
            "bad.pfm",
            b"PF\n2147483647 2147483647\n-1\n",
            "2147483647 x 2147483647 pixels need 55340232169589047308 bytes, not 0",
        ),
        ("bad.png", b"PF\n", "it is not a PNG file, but a PFM file: name it .pfm"),
        ("bad.png", JFIF, "it is not a PNG file, but a JPEG file: name it .jpg"),
        ("bad.png", b"v/1\x01\x02\0\0\0", "it is not a PNG file, but an EXR file: name it .exr"),
        (
            "bad.png",
            b"GIF89a and more than 24 bytes",
            "it is not a PNG file, but a GIF file: save it as PNG",
        ),
        (
            "bad.png",
            b"RIFF\x1A\0\0\0WEBPVP8 ",
            "it is not a PNG file, but a WebP file: save it as PNG",
        ),
        (
            "bad.png",
            b"RIFF\x1A\0\0\0WAVEfmt ",
            "it is not a PNG file: it begins with `RIFF\\x1a\\x00\\x00\\x00`",
        ),
        ("bad.png", b"<!DOCTYPE html>", "it is not a PNG file: it begins with `<!DOCTYP`"),
        ("bad.png", b"\x89PNG", "it is not a PNG file: "),
        ("bad.png", b"\x89PNG\r\n\x1A\n and no header chunk", "it is not a PNG file: "),
        ("bad.jpg", b"PF\n", "it is not a JPEG file, but a PFM file: name it .pfm"),
        ("bad.jpeg", b"", "it is not a JPEG file: it is empty"),
        ("bad.jpg", JFIF, "it is not a JPEG file: "),
        ("bad.exr", b"II*\0", "it is not an EXR file, but a TIFF file: save it as PNG or EXR"),
        ("bad.exr", b"v/1\x01", "it is not a readable EXR file: "),
        (
            "bad.pfm",
            b"#?RADIANCE\n",
            "it is not a PFM file, but a Radiance HDR file: save it as EXR",
        ),
        ("bad.tif", b"", "its name has to end in .exr, .jpg, .jpeg, .pfm or .png"),
    ];
    for (name, contents, reason) in cases {
        let file = path(name);
        fs::write(&file, contents).unwrap();
        let message = Image::read(&file).unwrap_err().to_string();
        assert!(
            message.starts_with(&format!("cannot read `{}`: {reason}", file.display())),
            "{message}"
        );
    }
    // Channels of a name that is no colour.
    use exr::prelude::{Image as Exr, SpecificChannels, WritableImage};
    let file = path("depth.exr");
    let channels = SpecificChannels::build().with_channel("Z").with_pixel_fn(|_| (1.0_f32,));
    Exr::from_channels((2, 2), channels).write().non_parallel().to_file(&file).unwrap();
    let expected =
        format!("cannot read `{}`: it has no channels R, G and B, nor Y", file.display());
    assert_eq!(Image::read(&file).unwrap_err().to_string(), expected);
}

/// The first part with colours is read, of any type of sample, compression and shape of blocks, at the largest resolution. Seen to
/// fail with tiles that all begin in the first column, and with the first part's table taken for that of the second.
#[test]
fn exr_of_other_programs() {
    use exr::prelude::{
        Blocks, Compression, Encoding as Exr, Image as ExrImage, Layer, LayerAttributes, LineOrder,
        SpecificChannels, Vec2, WritableImage, f16,
    };
    let size = (13, 10);
    let attributes = |name: &str| LayerAttributes {
        layer_position: Vec2(-5, 70),
        ..LayerAttributes::named(name)
    };
    // Halves of small integers, which every compression keeps.
    let number = |p: Vec2<usize>| (p.0 + 20 * p.1) as f32;
    let expected: Vec<f32> =
        (0..size.1).flat_map(|y| (0..size.0).map(move |x| (x + 20 * y) as f32)).collect();
    let compressions = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
    ];
    let shapes = [Blocks::ScanLines, Blocks::Tiles(Vec2(4, 3)), Blocks::Tiles(Vec2(64, 64))];
    for compression in compressions {
        for blocks in shapes {
            let encoding = Exr { compression, blocks, line_order: LineOrder::Increasing };
            let colors = SpecificChannels::build()
                .with_channel("A")
                .with_channel("B")
                .with_channel("G")
                .with_channel("R")
                .with_pixel_fn(|p: Vec2<usize>| {
                    let v = number(p);
                    (f16::ONE, 2 * v as u32, f16::from_f32(v), v + 0.5)
                });
            let depth = SpecificChannels::build().with_channel("Z").with_pixel_fn(|_| (1.0_f32,));
            let file = path("others.exr");
            ExrImage::from_layer(Layer::new((3, 2), attributes("depth"), encoding, depth))
                .with_layer(Layer::new(size, attributes("colors"), encoding, colors))
                .write()
                .non_parallel()
                .to_file(&file)
                .unwrap();
            let image = Image::read(&file).unwrap();
            assert_eq!(image.size, UVec2::new(13, 10));
            let found: Vec<_> = image.pixels.iter().map(|pixel| pixel.to_array()).collect();
            let expected: Vec<_> = expected.iter().map(|&v| [v + 0.5, v, 2.0 * v]).collect();
            assert_eq!(found, expected, "{compression:?} {blocks:?}");
            assert_eq!(image.variance, None);
        }
    }
}
