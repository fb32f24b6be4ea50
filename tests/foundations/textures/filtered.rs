//! Textures over the footprint of a pixel.

use std::sync::Arc;

use lobe::Spectrum;
use lobe::camera::{Camera, PerspectiveCamera, PerspectiveSettings};
use lobe::geometry::{BoundedPoint, PixelCone};
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::image::Encoding;
use lobe::interaction::{Partials, SurfaceInteraction};
use lobe::texture::{
    CheckerboardTexture, Curve, ImageTexture, Magnification, Mapping, Minification, Projection,
    Texels, Texture, Wrap,
};

use super::lookups::image;
use crate::common::Rng;

/// Greys without an order.
fn noise(size: [u32; 2], seed: u64) -> ImageTexture {
    let mut rng = Rng::new(seed, 0);
    let values: Vec<f32> = (0..size[0] * size[1]).map(|_| rng.f32()).collect();
    let texels = Texels::new(&image(size, Encoding::Linear, values), Curve::Linear).unwrap();
    ImageTexture::new(texels).with_minification(Minification::Anisotropic)
}

fn grey(color: Spectrum) -> f64 {
    f64::from(color.to_array()[0])
}

/// The mean over a parallelogram by 64 x 64 lookups.
fn brute_force(image: &ImageTexture, st: Vec2, [a, b]: [Vec2; 2]) -> f64 {
    let at = |i: u32| (i as f32 + 0.5) / 64.0 - 0.5;
    let row = |i: u32| (0..64).map(|j| grey(image.at(st + a * at(i) + b * at(j)))).sum::<f64>();
    (0..64).map(row).sum::<f64>() / 4096.0
}

/// Where pixels of the picture are no larger than those of the image nothing is filtered, to the bit. Seen to fail with a level of at
/// least 1.
#[test]
fn magnified_images_are_as_they_are() {
    let image = noise([37, 19], 1);
    let mut rng = Rng::new(700 + 2, 0);
    for trial in 0..1000 {
        let st = Vec2::new(4.0 * rng.f32() - 2.0, 4.0 * rng.f32() - 2.0);
        let steps = [Vec2::X * rng.f32() / 37.0, Vec2::Y * rng.f32() / 19.0];
        assert_eq!(image.mean(st, steps), image.at(st), "trial {trial}");
    }
}

/// From a footprint of four pixels to one of 1500 pixels, as wide as long or up to 12 times longer, the error against brute force is at most a
/// third of that of a single lookup, in the root of mean squares; at 1.5 pixels, 0.6 of it. Seen to fail with the level of the longer side, with that of half the
/// shorter side, and with lookups along half of the longer side.
#[test]
fn filtered_lookups_are_near_the_mean_over_the_footprint() {
    let mut failures = Vec::new();
    for (case, (size, wrap)) in [
        ([256, 256], Wrap::Repeat),
        ([256, 64], Wrap::Mirror),
        ([100, 333], Wrap::Repeat),
        ([1024, 1], Wrap::Repeat),
    ]
    .into_iter()
    .enumerate()
    {
        let image = noise(size, 3).with_wrap(wrap);
        let extent = UVec2::from(size).as_vec2();
        for width in [1.5_f32, 4.0, 11.0] {
            for ratio in [1.0, 4.0, 12.0] {
                let mut rng = Rng::new(700 + 4, 0);
                let (mut filtered, mut single) = (0.0, 0.0);
                for _ in 0..60 {
                    let st = Vec2::new(rng.f32(), rng.f32());
                    let turn = Vec2::from_angle(std::f32::consts::TAU * rng.f32());
                    // In pixels, then in the image's coordinates.
                    let steps = [turn * width * ratio, turn.perp() * width].map(|d| d / extent);
                    let mean = brute_force(&image, st, steps);
                    filtered += (grey(image.mean(st, steps)) - mean).powi(2);
                    single += (grey(image.at(st)) - mean).powi(2);
                }
                let quotient = (filtered / single).sqrt();
                // In one dimension, fewer pixels average out.
                let most = match (case, width < 2.0) {
                    (3, true) => 0.8,
                    (3, false) => 0.5,
                    (_, true) => 0.6,
                    (_, false) => 1.0 / 3.0,
                };
                if quotient > most {
                    failures.push(format!("case {case}, {width}, {ratio}: {quotient}"));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// The mean over all of an image is that of its smallest one, also of odd sizes, and a footprint of any size finds it. Seen to fail with
/// every second pixel left out, and with odd pixels dropped at the end.
#[test]
fn far_images_are_their_mean() {
    for size in [[1, 1], [2, 1], [3, 3], [5, 7], [1, 129], [255, 13]] {
        let mut rng = Rng::new(700 + 5, 0);
        let values: Vec<f32> = (0..size[0] * size[1]).map(|_| rng.f32()).collect();
        let mean = values.iter().map(|&x| f64::from(x)).sum::<f64>() / values.len() as f64;
        let texels = Texels::new(&image(size, Encoding::Linear, values), Curve::Linear).unwrap();
        let texture = ImageTexture::new(texels).with_minification(Minification::Anisotropic);
        for reach in [300.0, 1e6, 1e20] {
            let found = grey(texture.mean(Vec2::new(0.3, 0.7), [Vec2::X * reach, Vec2::Y * reach]));
            assert!((found - mean).abs() < 1e-5, "{size:?}, {reach}: {found}, not {mean}");
        }
        // What is not a number is not filtered.
        let st = Vec2::new(0.3, 0.7);
        assert_eq!(texture.mean(st, [Vec2::NAN, Vec2::X]), texture.at(st));
    }
}

/// A point of the plane z = 0 that is seen by a camera above it.
fn seen(cone: &PixelCone, p: Vec3) -> SurfaceInteraction<'_> {
    let partials =
        Partials { dpdu: 2.0 * Vec3::X, dpdv: Vec3::new(0.5, 1.0, 0.0), ..Partials::default() };
    // p = u dpdu + v dpdv.
    let uv = Vec2::new((p.x - 0.5 * p.y) / 2.0, p.y);
    SurfaceInteraction::new(BoundedPoint { p, error: Vec3::ZERO }, uv, Vec3::Z, partials)
        .seen_by(cone)
}

/// The footprint of a pixel at grazing angles, against the points that the neighbours' rays meet. Seen to fail without the cosine, with the
/// sides exchanged, and with the distance to the plane for that to the point.
#[test]
fn footprints_reach_to_the_next_pixels() {
    for eye in [Vec3::new(0.0, -10.0, 1.0), Vec3::new(3.0, 2.0, 5.0), Vec3::new(0.2, 0.1, 9.0)] {
        let look_at = Vec3::new(0.4, 0.3, 0.0);
        let settings =
            PerspectiveSettings { eye, look_at, up: Vec3::Z, fov: 30.0, ..Default::default() };
        let camera = PerspectiveCamera::new(&settings, UVec2::splat(512)).unwrap();
        let hit = |x: f32, y: f32| {
            let ray = camera.generate_ray(UVec2::splat(256), Vec2::new(x, y), Vec2::ZERO);
            ray.o - ray.d * (ray.o.z / ray.d.z)
        };
        let p = hit(0.0, 0.0);
        let cone = camera.pixel_cone().unwrap();
        let [across, away] = seen(&cone, p).footprint().unwrap();
        let expected = [hit(0.5, 0.0) - hit(-0.5, 0.0), hit(0.0, 0.5) - hit(0.0, -0.5)];
        for (found, expected) in [across, away].into_iter().zip(expected) {
            let same = (found - expected).length().min((found + expected).length());
            assert!(same < 0.01 * expected.length(), "{eye}: {found}, expected {expected}");
        }
        // Texture coordinates of a step.
        let si = seen(&cone, p);
        let step = si.uv_step(away);
        let back = step.x * si.dpdu() + step.y * si.dpdv();
        assert!(back.distance(away) < 1e-5 * away.length(), "{eye}: {back}, not {away}");
    }
}

/// Steps through every projection are differences of its coordinates. Seen to fail with the rotation left out, and with longitudes that
/// jump at the seam.
#[test]
fn every_projection_is_filtered() {
    let eye = Vec3::new(1.0, -6.0, 3.0);
    let cone = PixelCone::from_point(eye, 0.05);
    let turn = lobe::glam::Quat::from_rotation_x(0.7) * lobe::glam::Quat::from_rotation_y(0.4);
    let texture = || noise([64, 64], 7);
    for projection in [
        Projection::Uv,
        Projection::Planar,
        Projection::Cylindrical,
        Projection::Spherical,
        Projection::Triplanar,
    ] {
        let mapping = Mapping::new(projection)
            .placed(Vec3::new(0.1, 0.2, -1.5), turn)
            .scaled(Vec2::new(6.0, 0.7))
            .rotated(0.3);
        let filtered = texture().with_mapping(mapping);
        let single = texture().with_mapping(mapping).with_minification(Minification::None);
        let (mut error, mut error_of_one) = (0.0, 0.0);
        let mut rng = Rng::new(700 + 8, 0);
        for _ in 0..100 {
            let p = Vec3::new(4.0 * rng.f32() - 2.0, 4.0 * rng.f32() - 2.0, 0.0);
            let [a, b] = seen(&cone, p).footprint().unwrap();
            let at = |i: u32| (i as f32 + 0.5) / 32.0 - 0.5;
            let row = |i: u32| {
                let value = |j| grey(single.evaluate(&seen(&cone, p + a * at(i) + b * at(j))));
                (0..32).map(value).sum::<f64>()
            };
            let mean = (0..32).map(row).sum::<f64>() / 1024.0;
            error += (grey(filtered.evaluate(&seen(&cone, p))) - mean).powi(2);
            error_of_one += (grey(single.evaluate(&seen(&cone, p))) - mean).powi(2);
        }
        let quotient = (error / error_of_one).sqrt();
        assert!(quotient < 0.4, "{projection:?}: {quotient}");
    }
}

/// Over an edge, a footprint holds so much of each side, whichever of its sides is the longer one. Seen to fail with lookups along half of
/// the longer side, and with the sides exchanged.
#[test]
fn footprints_are_as_long_as_they_are() {
    let values = (0..256).map(|i| if i < 128 { 0.0 } else { 1.0 });
    let texels = Texels::new(&image([256, 1], Encoding::Linear, values), Curve::Linear).unwrap();
    let texture = ImageTexture::new(texels).with_wrap(Wrap::Clamp);
    let (long, short) = (Vec2::X * 0.5, Vec2::Y * 1e-3);
    for (s, part) in [(0.3, 0.1), (0.4, 0.3), (0.5, 0.5), (0.6, 0.7), (0.7, 0.9)] {
        for steps in [[long, short], [short, long], [-short, long]] {
            let found = grey(texture.mean(Vec2::new(s, 0.5), steps));
            assert!((found - part).abs() < 0.04, "{s}, {steps:?}: {found}, not {part}");
        }
    }
}

/// Seen to fail with steps that the mapping does not scale.
#[test]
fn steps_are_scaled_as_coordinates_are() {
    let scale = 8.0;
    let plain = noise([64, 64], 11);
    let scaled = plain.clone().with_mapping(Mapping::default().scaled(Vec2::splat(scale)));
    let cone = PixelCone::parallel(-Vec3::Z, 0.1);
    let si = seen(&cone, Vec3::new(0.31, 0.17, 0.0));
    let steps = si.footprint().unwrap().map(|step| si.uv_step(step) * scale);
    assert_eq!(scaled.evaluate(&si), plain.mean(si.uv() * scale, steps));
}

/// Across the seam of the longitudes nothing is blurred. Seen to fail with steps that go once around.
#[test]
fn seams_are_not_blurred() {
    // The axis is along y, the seam above it.
    let turn = lobe::glam::Quat::from_mat3(&lobe::glam::Mat3::from_cols(Vec3::Z, Vec3::X, Vec3::Y));
    for projection in [Projection::Cylindrical, Projection::Spherical] {
        let mapping = Mapping::new(projection).placed(Vec3::NEG_Z, turn);
        let texture = noise([64, 64], 9).with_mapping(mapping);
        let cone = PixelCone::parallel(-Vec3::Z, 0.001);
        for x in [-4e-4_f32, -1e-4, 1e-4, 4e-4] {
            let p = Vec3::new(x, 0.2, 0.0);
            let single = texture.clone().with_minification(Minification::None);
            let (found, near) =
                (texture.evaluate(&seen(&cone, p)), single.evaluate(&seen(&cone, p)));
            assert_eq!(found, near, "{projection:?}, {x}");
        }
    }
}

/// A checkerboard over a footprint has a closed form in the box around it; far away it is the mean of both, near by it is one or the other. Seen
/// to fail with the odd squares for the even ones, and with half of the footprint.
#[test]
fn checkerboards_are_filtered_in_closed_form() {
    let board = CheckerboardTexture::new(0.0_f32, 1.0_f32)
        .with_mapping(Mapping::new(Projection::Planar).rotated(0.4));
    let turn = Vec2::from_angle(0.4);
    // Parallel rays from above: squares of this width.
    for (trial, width) in [0.3_f32, 0.9, 1.7, 5.2].into_iter().enumerate() {
        let cone = PixelCone::parallel(-Vec3::Z, width);
        let mut rng = Rng::new(709, trial as u64);
        for _ in 0..50 {
            let p = Vec3::new(6.0 * rng.f32() - 3.0, 6.0 * rng.f32() - 3.0, 0.0);
            let [a, b] = seen(&cone, p).footprint().unwrap();
            let turned = |v: Vec3| turn.rotate(v.truncate());
            let (center, box_size) = (turned(p), turned(a).abs() + turned(b).abs());
            let at = |i: u32| (i as f32 + 0.5) / 256.0 - 0.5;
            let is_odd = |x: f32, y: f32| (x.floor() + y.floor()).rem_euclid(2.0);
            let row = |i: u32| {
                let x = center.x + box_size.x * at(i);
                (0..256).map(|j| f64::from(is_odd(x, center.y + box_size.y * at(j)))).sum::<f64>()
            };
            let mean = (0..256).map(row).sum::<f64>() / 65536.0;
            let found = f64::from(board.evaluate(&seen(&cone, p)));
            assert!((found - mean).abs() < 0.015, "{width}, {p}: {found}, not {mean}");
        }
    }
    let far = PixelCone::parallel(-Vec3::Z, 1e5);
    let found = board.evaluate(&seen(&far, Vec3::new(0.3, 0.4, 0.0)));
    assert!((found - 0.5).abs() < 1e-4, "{found}");
    let near = PixelCone::parallel(-Vec3::Z, 1e-4);
    let at = |x, y| board.evaluate(&seen(&near, Vec3::new(x, y, 0.0)));
    // Points of the turned squares.
    let square = |s: f32, t: f32| {
        let p = Vec2::from_angle(-0.4).rotate(Vec2::new(s, t));
        at(p.x, p.y)
    };
    let found = [square(0.5, 0.5), square(1.5, 0.5), square(-0.5, 0.5), square(-0.5, 1.5)];
    assert_eq!(found, [0.0, 1.0, 1.0, 0.0]);
}

/// An image is decoded once and its smaller images are made once, however many textures share them.
#[test]
fn textures_share_smaller_images() {
    let texels = Arc::new(
        Texels::new(&image([64, 64], Encoding::Linear, vec![0.5; 4096]), Curve::Linear).unwrap(),
    );
    let plain = texels.bytes();
    for _ in 0..3 {
        let texture = ImageTexture::new(texels.clone()).with_magnification(Magnification::Nearest);
        let _ = texture.with_minification(Minification::Anisotropic);
    }
    // A third more, with what is beyond the edges of the smallest.
    assert!(texels.bytes() > plain && texels.bytes() < plain * 3 / 2, "{}", texels.bytes());
}
