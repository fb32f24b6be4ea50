//! Colour scales of error maps.

use crate::image::Display;

/// A colour scale.
#[derive(Clone, Copy)]
pub enum Scale {
    /// From 0 to 1: dark blue, violet, orange, light yellow.
    Sequential,
    /// From -1 to 1: blue, nearly white, red.
    Diverging,
}

/// The sRGB codes of a value, which is clamped to the scale.
///
/// Colours are interpolated linearly between stops in Oklab (Ottosson 2020), so that lightness changes linearly.
pub fn color(scale: Scale, value: f32) -> [u8; 3] {
    const SEQUENTIAL: [[f32; 3]; 4] =
        [[0.16, 0.0, -0.07], [0.44, 0.10, -0.09], [0.71, 0.10, 0.12], [0.97, -0.03, 0.10]];
    const DIVERGING: [[f32; 3]; 3] = [[0.42, -0.02, -0.16], [0.97, 0.0, 0.0], [0.42, 0.14, 0.08]];
    match scale {
        Scale::Sequential => between(&SEQUENTIAL, value),
        Scale::Diverging => between(&DIVERGING, 0.5 + 0.5 * value),
    }
}

fn between(stops: &[[f32; 3]], value: f32) -> [u8; 3] {
    let last = stops.len() - 1;
    let position = value.clamp(0.0, 1.0) * last as f32;
    let first = (position as usize).min(last - 1);
    let part = position - first as f32;
    let mix = |i: usize| stops[first][i] + part * (stops[first + 1][i] - stops[first][i]);
    to_srgb([mix(0), mix(1), mix(2)])
}

/// From Oklab to sRGB codes: the inverse of the two matrices in Ottosson 2020, "A perceptual color space for image
/// processing", then the sRGB curve.
fn to_srgb([lightness, a, b]: [f32; 3]) -> [u8; 3] {
    let l = (lightness + 0.396_337_78 * a + 0.215_803_76 * b).powi(3);
    let m = (lightness - 0.105_561_346 * a - 0.063_854_17 * b).powi(3);
    let s = (lightness - 0.089_484_18 * a - 1.291_485_5 * b).powi(3);
    let linear = [
        4.076_741_7 * l - 3.307_711_6 * m + 0.230_969_93 * s,
        -1.268_438 * l + 2.609_757_4 * m - 0.341_319_4 * s,
        -0.004_196_086_3 * l - 0.703_418_6 * m + 1.707_614_7 * s,
    ];
    linear.map(|band| Display::Srgb.code(band))
}
