//! `PerspectiveSettings::framing`: all points are seen, and as large as they can be.

use lobe::PerspectiveSettings;
use lobe::camera::{Camera, CameraError, Handedness, PerspectiveCamera};
use lobe::glam::{UVec2, Vec2, Vec3};

use crate::projection::project;
use crate::rng::Rng;

/// Share of the image that points may fill.
const FILLED: f64 = 0.9;

/// A camera in a random direction, and an image of random format.
fn camera(rng: &mut Rng) -> (PerspectiveSettings, UVec2) {
    let settings = PerspectiveSettings {
        eye: rng.direction(),
        look_at: Vec3::ZERO,
        up: rng.direction(),
        handedness: if rng.below(2) == 0 { Handedness::Left } else { Handedness::Right },
        fov: rng.within(5.0, 120.0),
        ..PerspectiveSettings::default()
    };
    let side = |rng: &mut Rng| 1 + rng.below(2000) as u32;
    (settings, UVec2::new(side(rng), side(rng)))
}

/// Points in a box around `center`, its corners among them.
fn points(rng: &mut Rng, center: Vec3, half: Vec3) -> Vec<Vec3> {
    let corner =
        |i: usize| Vec3::from_array([1, 2, 4].map(|bit| if i & bit == 0 { -1.0 } else { 1.0 }));
    let inner = |rng: &mut Rng| {
        Vec3::new(rng.within(-1.0, 1.0), rng.within(-1.0, 1.0), rng.within(-1.0, 1.0))
    };
    let mut all: Vec<_> = (0..8).map(corner).collect();
    all.extend((0..20).map(|_| inner(rng)));
    all.into_iter().map(|p| center + half * p).collect()
}

/// The largest coordinate in the image, and the place in it.
fn extent(settings: &PerspectiveSettings, resolution: UVec2, points: &[Vec3]) -> f64 {
    let sizes = points.iter().map(|&p| {
        project(settings, resolution, p).map_or(f64::INFINITY, |at| at.abs().max_element())
    });
    sizes.fold(0.0, f64::max)
}

/// Boxes of any size, thin and flat ones among them, near the origin: all in the image, and one at the margin. Seen to fail
/// without the allowance for rounding, and without a least distance: boxes were touched at a corner.
#[test]
fn boxes_fill_the_image() {
    for trial in 0..2000 {
        let rng = &mut Rng::new(71, trial);
        let (settings, resolution) = camera(rng);
        let size = 10.0_f32.powf(rng.within(-6.0, 6.0));
        let mut half = Vec3::new(rng.f32(), rng.f32(), rng.f32()) * size;
        match rng.below(4) {
            0 => half[rng.below(3)] = 0.0,
            1 => half = Vec3::ZERO.with_x(half.x),
            2 => half[rng.below(3)] *= 1000.0,
            _ => {}
        }
        let center = rng.direction() * size;
        let points = points(rng, center, half);
        let framed = settings.framing(points.iter().copied(), resolution).unwrap();
        let extent = extent(&framed, resolution, &points);
        assert!(extent < FILLED + 1e-3, "trial {trial}: {extent} with {framed:?}");
        // Nothing is all but touched: the tip of a cone would be, if all of it is seen from there.
        let view = (framed.look_at - framed.eye).normalize();
        let depths = points.iter().map(|&p| (p - framed.eye).dot(view));
        let nearest = depths.fold(f32::INFINITY, f32::min) / (2.0 * half).length();
        assert!(nearest > 0.0999, "trial {trial}: {nearest} with {framed:?}");
        // Rounding of the camera's place is allowed for, which is much for what is thin and seen from its end.
        let is_thick = half.min_element() > 0.05 * (center.abs() + half).max_element();
        let is_free = is_thick && nearest > 0.1001;
        assert!(extent > FILLED - 1e-3 || !is_free, "trial {trial}: {extent} with {framed:?}");
        // The view has not turned.
        let [before, after] = [settings, framed].map(|s| (s.look_at - s.eye).normalize());
        assert!(before.dot(after) > 1.0 - 1e-5, "trial {trial}: {before} became {after}");
    }
}

/// The closed form is what the camera does: the ray through the point of the image meets the point in the world.
#[test]
fn the_projection_is_the_cameras() {
    for trial in 0..200 {
        let rng = &mut Rng::new(72, trial);
        let (settings, resolution) = camera(rng);
        let center = rng.direction();
        let points = points(rng, center, Vec3::ONE);
        let framed = settings.framing(points.iter().copied(), resolution).unwrap();
        let camera = PerspectiveCamera::new(&framed, resolution).unwrap();
        for p in points {
            let at = project(&framed, resolution, p).unwrap().as_vec2();
            let film = (at * Vec2::new(0.5, -0.5) + 0.5) * resolution.as_vec2();
            let pixel = film.floor();
            let ray = camera.generate_ray(pixel.as_uvec2(), film - pixel, Vec2::ZERO);
            let cosine = (p - ray.o).normalize().dot(ray.d);
            assert!(cosine > 1.0 - 1e-5, "trial {trial}: {p} is {cosine} off");
        }
    }
}

/// Where f32 cannot tell points well, the camera stands back. Seen within the image all the same. Seen to
/// fail without the allowance for rounding.
#[test]
fn far_from_the_origin_all_is_seen() {
    for trial in 0..2000 {
        let rng = &mut Rng::new(73, trial);
        let (settings, resolution) = camera(rng);
        let far = rng.direction() * 10.0_f32.powf(rng.within(2.0, 7.0));
        let points = points(rng, far, Vec3::ONE);
        let framed = settings.framing(points.iter().copied(), resolution).unwrap();
        let extent = extent(&framed, resolution, &points);
        assert!(extent < FILLED + 1e-3, "trial {trial}: {extent} with {framed:?}");
    }
}

#[test]
fn points_that_are_none_or_one() {
    let settings = PerspectiveSettings::default();
    let resolution = UVec2::new(4, 3);
    assert_eq!(settings.framing([].into_iter(), resolution), Ok(settings));
    let beyond = [Vec3::NAN, Vec3::X * 2e12];
    assert_eq!(settings.framing(beyond.into_iter(), resolution), Ok(settings));
    for point in [Vec3::ZERO, Vec3::new(1.0, -2.0, 1e6), Vec3::splat(1e-40)] {
        let framed = settings.framing([point, Vec3::NAN].into_iter(), resolution).unwrap();
        let at = project(&framed, resolution, point).unwrap();
        assert!(at.abs().max_element() < FILLED, "{point} is at {at}");
        PerspectiveCamera::new(&framed, resolution).unwrap();
    }
    let without_direction = PerspectiveSettings { look_at: Vec3::ZERO, ..settings };
    let refused = without_direction.framing([Vec3::X].into_iter(), resolution);
    assert_eq!(refused, Err(CameraError::NoDirection));
    let no_pixels = settings.framing([Vec3::X].into_iter(), UVec2::new(0, 3));
    assert_eq!(no_pixels, Err(CameraError::Resolution(0, 3)));
}
