//! Where a camera stands, and its axes in the world.

use glam::{DVec3, UVec2, Vec3};

use super::error::CameraError;
use crate::geometry::Xyz;
use crate::geometry::float::MAX_COORDINATE_F64;
use crate::params::{Fault, Handedness, Key, Table};
use crate::sampling::concentric_disk;
use crate::simd::Float;

pub(super) const EYE: Key<Vec3> = Key::new("eye", "where it stands")
    .range(-MAX_COORDINATE_F64..=MAX_COORDINATE_F64)
    .default(Vec3::ZERO);
pub(super) const LOOK_AT: Key<Vec3> = Key::new("look_at", "a point in the middle of the image")
    .range(-MAX_COORDINATE_F64..=MAX_COORDINATE_F64)
    .default(Vec3::Z);
pub(super) const UP: Key<Vec3> =
    Key::new("up", "a direction that is up in the image").default(Vec3::Y);
pub(super) const HANDEDNESS: Key<Handedness> = Handedness::KEY;
pub(super) const LENS_RADIUS: Key<f32> =
    Key::new("lens_radius", "radius of the lens, in scene units; 0 for a pinhole")
        .range(0.0..=MAX_COORDINATE_F64)
        .default(0.0);
pub(super) const FOCAL_DISTANCE: Key<f32> =
    Key::new("focal_distance", "distance of the plane in focus, in scene units; for a lens")
        .above(0.0)
        .default(1.0);

/// Places a camera error at the key that caused it. Values out of their keys' ranges are refused before.
pub(super) fn fault(table: &Table, error: CameraError) -> Fault {
    let key = if error == CameraError::NoUp { UP } else { LOOK_AT };
    Fault::new(table.mark(&key), error)
}

/// A camera's point of view and its axes, each of unit length and across the others. In f64, so that a camera far from
/// the origin still looks where it should.
pub(super) struct Axes {
    pub right: DVec3,
    pub up: DVec3,
    pub forward: DVec3,
}

impl Axes {
    /// The axes of a camera at `eye` with `look_at` in the middle of its image.
    pub fn new(
        eye: Vec3,
        look_at: Vec3,
        up: Vec3,
        handedness: Handedness,
    ) -> Result<Self, CameraError> {
        for (key, point) in [(EYE, eye), (LOOK_AT, look_at)] {
            if !point.to_array().iter().all(|x| key.limits().contains_f32(*x)) {
                return Err(CameraError::OutOfRange(key.name(), point));
            }
        }
        if !up.is_finite() {
            return Err(CameraError::Up(up));
        }
        let [eye, look_at, up]: [DVec3; 3] = [eye, look_at, up].map(DVec3::from);
        let forward = (look_at - eye).try_normalize().ok_or(CameraError::NoDirection)?;
        let right =
            up.normalize_or_zero().cross(forward).try_normalize().ok_or(CameraError::NoUp)?;
        // Across both before right is flipped: up is up in either kind of world.
        let up = forward.cross(right);
        let right = match handedness {
            Handedness::Left => right,
            Handedness::Right => -right,
        };
        Ok(Self { right, up, forward })
    }
}

/// The point of the lens that a sample value is mapped to, relative to its middle. `axes` are half its width and height.
#[inline(always)]
pub(super) fn point_on_lens<F: Float>(axes: [Vec3; 2], u: [F; 2]) -> Xyz<F> {
    let [x, y] = concentric_disk::sample_wide(u);
    Xyz::splat(axes[0]) * x + Xyz::splat(axes[1]) * y
}

/// Checks a lens: its radius and the distance of the plane in focus.
pub(super) fn check_lens(radius: f32, focal_distance: f32) -> Result<(), CameraError> {
    if !LENS_RADIUS.limits().contains_f32(radius) {
        return Err(CameraError::LensRadius(radius));
    }
    if !(FOCAL_DISTANCE.limits().contains_f32(focal_distance) && focal_distance.is_finite()) {
        return Err(CameraError::FocalDistance(focal_distance));
    }
    Ok(())
}

/// Checks that an image has pixels.
pub(super) fn check_resolution(resolution: UVec2) -> Result<(), CameraError> {
    if resolution.min_element() == 0 {
        return Err(CameraError::Resolution(resolution.x, resolution.y));
    }
    Ok(())
}

impl Handedness {
    /// Suffix for descriptions; empty for the default.
    pub(super) fn note(self) -> &'static str {
        match self {
            Self::Left => "",
            Self::Right => ", right-handed",
        }
    }
}
