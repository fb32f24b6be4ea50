//! Values of images: codes, what is between pixels, and what is beyond the edges.

use std::sync::Arc;

use lobe::Spectrum;
use lobe::glam::{UVec2, Vec2};
use lobe::image::{Encoding, Image};
use lobe::texture::{
    Channel, Curve, ImageTexture, Magnification, Texels, TexelsError, Texture, Wrap,
};

use super::at;
use crate::common::Rng;

/// An image of greys.
pub fn image(size: [u32; 2], encoding: Encoding, values: impl IntoIterator<Item = f32>) -> Image {
    let pixels: Vec<_> = values.into_iter().map(Spectrum::splat).collect();
    let size = UVec2::from(size);
    assert_eq!(pixels.len() as u32, size.x * size.y);
    Image { size, pixels, variance: None, degrees_of_freedom: None, encoding }
}

fn meaning(curve: Curve, code: f64) -> f32 {
    (match curve {
        Curve::Srgb if code <= 0.04045 => code / 12.92,
        Curve::Srgb => ((code + 0.055) / 1.055).powf(2.4),
        Curve::Gamma22 => code.powf(2.2),
        Curve::Linear => code,
    }) as f32
}

const CURVES: [Curve; 3] = [Curve::Srgb, Curve::Gamma22, Curve::Linear];

/// Codes of 8 bits take 4 bytes a pixel, and each stands for the nearest `f32` of what IEC 61966-2-1 says. Seen to fail with codes
/// rounded to `f32` before they are decoded, and with 2.4 for 2.2.
#[test]
fn codes_of_8_bits_are_exact() {
    for curve in CURVES {
        let codes = (0..=255_u8).map(|code| f32::from(code) / 255.0);
        let texels = Texels::new(&image([16, 16], Encoding::Srgb, codes), curve).unwrap();
        assert_eq!(texels.bytes(), 4 * 256 + 4 * 256);
        for code in 0..256 {
            let expected = Spectrum::splat(meaning(curve, f64::from(code) / 255.0));
            assert_eq!(texels.at(code % 16, code / 16), expected, "{curve:?} {code}");
        }
    }
}

/// Codes of 16 bits are decoded one by one, to 12 bytes a pixel. Seen to fail with codes rounded to 8 bits.
#[test]
fn codes_of_16_bits_keep_their_precision() {
    for curve in CURVES {
        let codes = |code: u16| f32::from(code) / 65535.0;
        let texels = image([256, 256], Encoding::Srgb, (0..=65535).map(codes));
        let texels = Texels::new(&texels, curve).unwrap();
        assert_eq!(texels.bytes(), 12 << 16);
        for code in 0..=65535_u16 {
            let expected = Spectrum::splat(meaning(curve, f64::from(codes(code))));
            let (x, y) = (u32::from(code) % 256, u32::from(code) / 256);
            assert_eq!(texels.at(x, y), expected, "{curve:?} {code}");
        }
    }
}

/// Radiance is what it is, whatever the curve, also where it looks like codes. Seen to fail with the curve applied to it.
#[test]
fn radiance_stays_as_it_is() {
    let values = [0.0, -0.0, 1e-45, 0.25, 1.0, 51.0 / 255.0, 7.5, f32::MAX];
    for (curve, values) in CURVES.into_iter().flat_map(|curve| [(curve, values), (curve, [1.0; 8])])
    {
        let texels = Texels::new(&image([8, 1], Encoding::Linear, values), curve).unwrap();
        // Two tiles of 16 pixels.
        assert_eq!(texels.bytes(), 2 * 16 * 12);
        for (x, value) in values.into_iter().enumerate() {
            let found = texels.at(x as u32, 0).to_array().map(f32::to_bits);
            assert_eq!(found, [value.to_bits(); 3], "{curve:?}");
        }
    }
}

/// The pixel of the unbounded image, by walking there.
fn reference_index(index: i64, count: i64, wrap: Wrap) -> i64 {
    let (mut tile, mut within) = (index / count, index % count);
    if within < 0 {
        (tile, within) = (tile - 1, within + count);
    }
    match wrap {
        Wrap::Repeat => within,
        Wrap::Mirror if tile % 2 != 0 => count - 1 - within,
        Wrap::Mirror => within,
        Wrap::Clamp if tile < 0 => 0,
        Wrap::Clamp if tile > 0 => count - 1,
        Wrap::Clamp => within,
    }
}

/// In `f64`; `values` row by row from the top.
fn reference(
    values: &[f32],
    size: [u32; 2],
    wrap: Wrap,
    magnification: Magnification,
    st: Vec2,
) -> f64 {
    let [width, height] = size.map(i64::from);
    let value = |column: i64, row_from_below: i64| {
        let x = reference_index(column, width, wrap);
        let y = height - 1 - reference_index(row_from_below, height, wrap);
        f64::from(values[(y * width + x) as usize])
    };
    let (s, t) = (f64::from(st.x) * width as f64, f64::from(st.y) * height as f64);
    if magnification == Magnification::Nearest {
        return value(s.floor() as i64, t.floor() as i64);
    }
    // The four nearest centres, each weighted by the rectangle to the opposite one.
    let mut sum = 0.0;
    for column in [(s - 0.5).floor(), (s + 0.5).floor()] {
        for row in [(t - 0.5).floor(), (t + 0.5).floor()] {
            let weight = (1.0 - (s - column - 0.5).abs()) * (1.0 - (t - row - 0.5).abs());
            sum += weight * value(column as i64, row as i64);
        }
    }
    sum
}

const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];
const MAGNIFICATIONS: [Magnification; 2] = [Magnification::Bilinear, Magnification::Nearest];

/// Against a reference of its own, for all sides, at edges, centres and anywhere, near and far. Seen to fail with coordinates in
/// `f32` (far from the image), with the nearest pixel rounded away from 0 (at the edges), and with t downwards.
#[test]
fn lookups_equal_the_reference() {
    let sizes = [[1, 1], [2, 1], [1, 2], [3, 5], [7, 4], [1000, 3], [16384, 1], [1, 16384]];
    for (test, size) in sizes.into_iter().enumerate() {
        let mut rng = Rng::new(0x7e71, test as u64);
        let values: Vec<f32> = (0..size[0] * size[1]).map(|_| rng.f32()).collect();
        let texels = Arc::new(
            Texels::new(&image(size, Encoding::Linear, values.iter().copied()), Curve::Linear)
                .unwrap(),
        );
        for wrap in WRAPS {
            for magnification in MAGNIFICATIONS {
                let texture = ImageTexture::new(texels.clone())
                    .with_wrap(wrap)
                    .with_magnification(magnification);
                for trial in 0..2000 {
                    let mut rng = Rng::new(0x7e72 + test as u64, trial);
                    let st = Vec2::from(size.map(|side| coordinate(&mut rng, side)));
                    let expected = reference(&values, size, wrap, magnification, st);
                    let found = texture.at(st).to_array();
                    assert!(
                        found.iter().all(|&band| (f64::from(band) - expected).abs() < 1e-6),
                        "size {test}, {wrap:?}, {magnification:?}, trial {trial}, {st}: {found:?}, \
                         expected {expected}"
                    );
                }
            }
        }
    }
}

fn coordinate(rng: &mut Rng, side: u32) -> f32 {
    let pixel = rng.below(3 * side as usize + 1) as f32 - side as f32;
    match rng.below(6) {
        0 => rng.within(-2.0, 3.0),
        1 => pixel / side as f32,
        2 => (pixel + 0.5) / side as f32,
        3 => [-0.0, 0.0, 1.0, -1.0, 2.0, 1e-30, -1e-30, 0.99999994][rng.below(8)],
        4 => rng.within(-1e6, 1e6),
        _ => rng.within(-1e4, 1e4),
    }
}

/// Beyond 64 bits, and where there is no number at all, a lookup gives a value all the same. Seen to fail without the check of
/// finite coordinates, and with t downwards.
#[test]
fn lookups_anywhere_have_values() {
    let values = [0.25, 0.5, 0.75, 1.0, 0.0, 0.125];
    let texels =
        Arc::new(Texels::new(&image([3, 2], Encoding::Linear, values), Curve::Linear).unwrap());
    let edges = [1e18, 1e19, 1e30, f32::MAX, -1e18, -1e19, -1e30, f32::MIN, 0.5];
    for (wrap, magnification) in
        WRAPS.into_iter().flat_map(|wrap| MAGNIFICATIONS.map(|magnification| (wrap, magnification)))
    {
        let texture =
            ImageTexture::new(texels.clone()).with_wrap(wrap).with_magnification(magnification);
        for (s, t) in edges.into_iter().flat_map(|s| edges.map(|t| (s, t))) {
            let value = texture.at(Vec2::new(s, t)).to_array()[0];
            assert!((0.0..=1.0).contains(&value), "{wrap:?} {magnification:?} {s} {t}: {value}");
        }
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            for st in [Vec2::new(bad, 0.5), Vec2::new(0.5, bad)] {
                assert_eq!(texture.at(st), Spectrum::BLACK, "{wrap:?} {magnification:?} {st}");
            }
        }
        if wrap == Wrap::Clamp {
            // Corners, from the bottom left: the last row of the image is at t = 0.
            let corner = |s: f32, t: f32| texture.at(Vec2::new(s, t)).to_array()[0];
            let found =
                [corner(-9.0, -9.0), corner(9.0, -9.0), corner(-9.0, 9.0), corner(9.0, 9.0)];
            assert_eq!(found, [1.0, 0.125, 0.25, 0.75]);
        }
    }
}

/// A mirrored image is symmetric about each edge. Seen to fail with the edge's pixel left out of the mirror.
#[test]
fn mirrors_are_symmetric_about_edges() {
    let texels =
        Texels::new(&image([5, 1], Encoding::Linear, [0.1, 0.9, 0.3, 0.7, 0.2]), Curve::Linear)
            .unwrap();
    let texture = ImageTexture::new(texels).with_wrap(Wrap::Mirror);
    for edge in -3..=3 {
        for step in 1..=64 {
            let [a, b] = [1.0, -1.0].map(|side| edge as f32 + side * step as f32 / 64.0);
            let [a, b] = [a, b].map(|s| texture.at(Vec2::new(s, 0.5)).to_array()[0]);
            assert!((a - b).abs() < 1e-6, "{edge} {step}: {a} {b}");
        }
    }
}

/// Numbers are one band, or the luminance of Rec. 709. Seen to fail with bands exchanged and with weights of Rec. 601.
#[test]
fn numbers_are_bands_of_an_image() {
    let mut image = image([1, 1], Encoding::Linear, [0.0]);
    image.pixels[0] = Spectrum::new(0.5, 0.25, 1.0);
    let texels = Arc::new(Texels::new(&image, Curve::Linear).unwrap());
    let luminance = 0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722;
    for (channel, expected) in [
        (Channel::Red, 0.5),
        (Channel::Green, 0.25),
        (Channel::Blue, 1.0),
        (Channel::Luminance, luminance),
    ] {
        let number = ImageTexture::new(texels.clone()).channel(channel);
        assert!((number.evaluate(&at(Vec2::splat(0.3))) - expected).abs() < 1e-7, "{channel:?}");
    }
}

/// What cannot be looked up is refused with its reason. Caught: images of no pixels or too few, negative pixels, and the place by rows.
#[test]
fn images_that_cannot_be_looked_up() {
    let refused = |size: [u32; 2], values: Vec<f32>| {
        let whole = [1, values.len() as u32];
        let image = Image { size: size.into(), ..image(whole, Encoding::Linear, values) };
        Texels::new(&image, Curve::Linear).err().expect("refused")
    };
    for (size, pixels) in [([2, 2], 3), ([0, 4], 0), ([0, 4], 2), ([1, 0], 1), ([1 << 31; 2], 1)] {
        let expected = TexelsError::Size { size: size.into(), pixels };
        assert_eq!(refused(size, vec![0.5; pixels]), expected);
    }
    let message = refused([2, 2], vec![0.5; 3]).to_string();
    assert_eq!(message, "3 pixels for 2 x 2, expected one for each, and at least one");
    for (value, text) in [(-0.5, "-0.5"), (f32::NAN, "NaN"), (f32::INFINITY, "inf")] {
        assert_eq!(
            refused([3, 2], vec![0.0, 1.0, 2.0, 3.0, 4.0, value]).to_string(),
            format!(
                "the pixel of column 2 and row 1, which count from 0 at the top left, is [{text}, {text}, {text}], \
                 expected finite numbers of at least 0"
            )
        );
    }
}
