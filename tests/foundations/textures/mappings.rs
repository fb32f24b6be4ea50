//! Where on a texture a point of a surface lies.

use std::f32::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use lobe::geometry::BoundedPoint;
use lobe::glam::{DVec3, Quat, Vec2, Vec3};
use lobe::image::Encoding;
use lobe::interaction::{Partials, SurfaceInteraction};
use lobe::texture::{Curve, ImageTexture, Mapping, Projection, Texels, Texture, Wrap};

use super::lookups::image;
use crate::common::Rng;

/// A point with a normal and texture coordinates.
fn point(p: Vec3, n: Vec3, uv: Vec2) -> SurfaceInteraction<'static> {
    let dpdu = n.any_orthonormal_vector();
    let partials = Partials { dpdu, dpdv: n.cross(dpdu), ..Partials::default() };
    SurfaceInteraction::new(BoundedPoint { p, error: Vec3::ZERO }, uv, n, partials)
}

/// An image of 1024 pixels whose value is the coordinate, but for half a pixel at each end.
fn ramp(along_s: bool) -> ImageTexture {
    let value = |i: u32| (i as f32 + 0.5) / 1024.0;
    let texels = match along_s {
        true => image([1024, 1], Encoding::Linear, (0..1024).map(value)),
        false => image([1, 1024], Encoding::Linear, (0..1024).rev().map(value)),
    };
    ImageTexture::new(Texels::new(&texels, Curve::Linear).unwrap()).with_wrap(Wrap::Clamp)
}

/// Half a pixel of the ramp.
const HALF: f32 = 0.5 / 1024.0;

/// s and t, from 1/2048 to 1 - 1/2048.
fn coordinates(mapping: Mapping, si: &SurfaceInteraction) -> Vec2 {
    let along = |s| ramp(s).with_mapping(mapping).evaluate(si).to_array()[0];
    Vec2::new(along(true), along(false))
}

#[track_caller]
fn assert_near(found: Vec2, expected: [f32; 2], what: impl std::fmt::Debug) {
    let half = HALF;
    let expected = Vec2::from(expected).clamp(Vec2::splat(half), Vec2::splat(1.0 - half));
    assert!(
        (found - expected).abs().max_element() < 2e-6,
        "{what:?}: {found}, expected {expected}"
    );
}

/// Scaled, then rotated, then moved. Seen to fail with the scale or the offset before what is there, and with the rotation
/// reversed.
#[test]
fn coordinates_are_scaled_then_rotated_then_moved() {
    let mapping = Mapping::default()
        .scaled(Vec2::new(0.5, 0.25))
        .rotated(FRAC_PI_2)
        .moved(Vec2::new(0.75, 0.125));
    // (0.4, 0.8) -> (0.2, 0.2) -> (-0.2, 0.2).
    assert_near(
        coordinates(mapping, &point(Vec3::ZERO, Vec3::Z, Vec2::new(0.4, 0.8))),
        [0.55, 0.325],
        "uv",
    );
    // Texture coordinates have no place in the world.
    let placed = mapping.placed(Vec3::ONE, Quat::from_rotation_x(1.0));
    let si = point(Vec3::splat(7.0), Vec3::Z, Vec2::new(0.4, 0.8));
    assert_near(coordinates(placed, &si), [0.55, 0.325], "placed");
    // In the order of the calls: moved first, it is scaled, too.
    let other = Mapping::default().moved(Vec2::splat(0.5)).scaled(Vec2::splat(0.5));
    assert_near(
        coordinates(other, &point(Vec3::ZERO, Vec3::Z, Vec2::new(0.1, 0.3))),
        [0.3, 0.4],
        "other",
    );
}

/// Seen to fail with the axes turned the other way, and with the origin subtracted after the turn.
#[test]
fn planes_have_an_origin_and_axes() {
    for trial in 0..200 {
        let mut rng = Rng::new(0x3a90, trial);
        let mut vector = || Vec3::from([0; 3].map(|_| rng.within(-1.0, 1.0)));
        let (p, center, axis) = (vector(), vector(), vector().normalize());
        let turn = Quat::from_axis_angle(axis, 5.0 * axis.x);
        let q = p - center;
        let [s, t] = [Vec3::X, Vec3::Y].map(|e| 0.5 + 0.2 * q.dot(turn * e));
        let mapping = Mapping::new(Projection::Planar)
            .placed(center, turn)
            .scaled(Vec2::splat(0.2))
            .moved(Vec2::splat(0.5));
        assert_near(coordinates(mapping, &point(p, Vec3::Z, Vec2::ZERO)), [s, t], trial);
    }
}

/// Longitude goes once from 0 to 1, from x towards y, with its seam at x alone. Seen to fail with longitudes from -1/2 to 1/2.
#[test]
fn cylinders_have_their_seam_at_x() {
    let mapping = Mapping::new(Projection::Cylindrical);
    for (y, x, s) in [
        (0.0, 1.0, 0.0),
        (-0.0, 1.0, 0.0),
        (1.0, 0.0, 0.25),
        (0.0, -1.0, 0.5),
        (-0.0, -1.0, 0.5),
        (1e-7, -1.0, 0.5),
        (-1e-7, -1.0, 0.5),
        (-1.0, 0.0, 0.75),
        (-1e-6, 1.0, 1.0),
        (-1e-30, 1.0, 1.0),
    ] {
        for radius in [1e-3, 1.0, 1e6] {
            let p = Vec3::new(radius * x, radius * y, 0.375);
            assert_near(coordinates(mapping, &point(p, Vec3::Z, Vec2::ZERO)), [s, 0.375], (x, y));
        }
    }
}

/// Seen to fail with latitudes by the arc sine of z over the length, which is no number in the centre, and with poles exchanged.
#[test]
fn spheres_have_poles_and_a_centre() {
    let mapping = Mapping::new(Projection::Spherical);
    for (p, t) in [
        (Vec3::Z, 1.0),
        (-Vec3::Z, 0.0),
        (Vec3::ZERO, 0.5),
        (-Vec3::ZERO, 0.5),
        (Vec3::new(1e-30, 0.0, 1.0), 1.0),
        (Vec3::new(-1e-8, 1e-8, -1.0), 0.0),
        (Vec3::new(3.0, 4.0, 5.0), 0.75),
        (Vec3::new(-3e-12, 4e-12, -5e-12), 0.25),
        (Vec3::new(3e11, -4e11, 5e11), 0.75),
    ] {
        let found = coordinates(mapping, &point(p, Vec3::Z, Vec2::ZERO));
        assert_near(Vec2::new(0.5, found.y), [0.5, t], p);
        assert!(found.is_finite(), "{p}");
    }
    for trial in 0..200 {
        let mut rng = Rng::new(0x3a91, trial);
        let (s, t) = (rng.f32(), rng.f32());
        let (phi, theta) = (s * TAU, (t - 0.5) * TAU / 2.0);
        let direction = Vec3::new(theta.cos() * phi.cos(), theta.cos() * phi.sin(), theta.sin());
        let (center, radius) = (Vec3::new(1.0, -2.0, 0.5), rng.within(0.5, 4.0));
        let mapping = mapping.placed(center, Quat::IDENTITY);
        let found = coordinates(mapping, &point(center + radius * direction, Vec3::Z, Vec2::ZERO));
        // Near the poles, and where the seam is, longitude is a matter of the last digit.
        let slack = 1e-6 / theta.cos().max(1e-6);
        let seam = (found.x - s).abs().min(1.0 - (found.x - s).abs());
        assert!(seam < slack + 1e-3, "trial {trial}: {found}, expected {s} {t}");
        assert!((found.y - t.clamp(HALF, 1.0 - HALF)).abs() < 1e-5, "trial {trial}: {found}, {t}");
    }
}

/// Weights are fourth powers of the normal's coordinates and add up to 1. Seen to fail with second powers, and with weights of two
/// planes exchanged.
#[test]
fn three_planes_are_mixed_by_the_normal() {
    let white = Texels::new(&image([1, 1], Encoding::Linear, [1.0]), Curve::Linear).unwrap();
    let white =
        ImageTexture::new(Arc::new(white)).with_mapping(Mapping::new(Projection::Triplanar));
    for trial in 0..500 {
        let mut rng = Rng::new(0x3a92, trial);
        let mut vector = || Vec3::from([0; 3].map(|_| rng.within(-1.0, 1.0)));
        let (p, turn, n) = (vector(), vector().normalize(), vector());
        let n = match trial % 4 {
            0 => [Vec3::X, -Vec3::Y, Vec3::Z][trial as usize / 4 % 3],
            1 => n.with_x(0.0).normalize(),
            _ => n.normalize(),
        };
        let si = point(p, n, Vec2::ZERO);
        let sum = white.evaluate(&si).to_array()[0];
        assert!((sum - 1.0).abs() < 1e-6, "trial {trial}: {sum}");
        let turn = Quat::from_axis_angle(turn, turn.y);
        let mapping = Mapping::new(Projection::Triplanar)
            .placed(Vec3::splat(0.25), turn)
            .scaled(Vec2::splat(0.2))
            .moved(Vec2::splat(0.5));
        let axes = [Vec3::X, Vec3::Y, Vec3::Z].map(|e| (turn * e).as_dvec3());
        let along = |v: Vec3| DVec3::from(axes.map(|axis| axis.dot(v.as_dvec3())));
        let (q, w) = (along(p - Vec3::splat(0.25)), along(n));
        let w = w.powf(2.0) * w.powf(2.0) / (w.powf(2.0) * w.powf(2.0)).element_sum();
        // The planes of y and z, x and z, x and y.
        let s = w.dot(DVec3::new(q.y, q.x, q.x)) * 0.2 + 0.5;
        let t = w.dot(DVec3::new(q.z, q.z, q.y)) * 0.2 + 0.5;
        let found = coordinates(mapping, &si).as_dvec2();
        assert!(
            (found.x - s).abs() < 5e-6 && (found.y - t).abs() < 5e-6,
            "trial {trial}: {found}, {s} {t}"
        );
    }
}
