//! [`PerspectiveCamera`]: what is farther away is smaller.

use std::sync::Arc;

use glam::{UVec2, Vec2, Vec3};

use super::block::{CameraSamples, WideCamera, ray_of_one, rays_wide};
use super::error::CameraError;
use super::placement::{
    Axes, EYE, FOCAL_DISTANCE, HANDEDNESS, LENS_RADIUS, LOOK_AT, UP, check_lens, check_resolution,
    fault, point_on_lens,
};
use super::traits::{Camera, Read};
use crate::geometry::{PixelCone, Ray, Xyz};
use crate::params::{Fault, Handedness, Key, Kind, Table};
use crate::simd::{Float, four};

/// How a perspective camera stands and sees. The defaults look from the origin along +z, 90 degrees wide.
/// Coordinates and the lens radius go up to [`MAX_COORDINATE`](crate::geometry::float::MAX_COORDINATE).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerspectiveSettings {
    /// Where it stands, in world space.
    pub eye: Vec3,
    /// A point in the middle of the image, other than `eye`.
    pub look_at: Vec3,
    /// A direction that is up in the image, of any length but zero; need not be across the view, but not along it.
    pub up: Vec3,
    /// Which kind of space the world is.
    pub handedness: Handedness,
    /// Field of view in degrees across the shorter side of the image, above 0 and below 180.
    pub fov: f32,
    /// Radius of the lens in scene units; 0 is a pinhole, which sees everything sharply.
    pub lens_radius: f32,
    /// Distance of the plane in focus along the view, in scene units, above 0. Only a lens uses it.
    pub focal_distance: f32,
}

impl Default for PerspectiveSettings {
    fn default() -> Self {
        Self {
            eye: Vec3::ZERO,
            look_at: Vec3::Z,
            up: Vec3::Y,
            handedness: Handedness::Left,
            fov: 90.0,
            lens_radius: 0.0,
            focal_distance: 1.0,
        }
    }
}

/// A perspective camera with a thin lens or a pinhole (PBRT 3rd edition, sections 6.2.2 and 6.2.3).
#[doc(alias = "pinhole")]
#[doc(alias = "thin lens")]
#[doc(alias = "depth of field")]
#[derive(Clone, Copy, Debug)]
pub struct PerspectiveCamera {
    settings: PerspectiveSettings,
    resolution: UVec2,
    /// To the middle of the image, on the plane at distance 1.
    forward: Vec3,
    /// Along one pixel to the right and one down, on the same plane.
    pixel_x: Vec3,
    pixel_y: Vec3,
    half_resolution: Vec2,
    /// Half the width and half the height of the lens, as vectors in the world.
    lens: Option<[Vec3; 2]>,
}

impl PerspectiveCamera {
    /// A camera for images of `resolution` pixels.
    ///
    /// # Errors
    /// If a setting is out of its range, or if the settings leave open where the camera looks.
    pub fn new(settings: &PerspectiveSettings, resolution: UVec2) -> Result<Self, CameraError> {
        let PerspectiveSettings { eye, look_at, up, handedness, fov, lens_radius, focal_distance } =
            *settings;
        let Axes { right, up, forward } = Axes::new(eye, look_at, up, handedness)?;
        if !FOV.limits().contains_f32(fov) {
            return Err(CameraError::Fov(fov));
        }
        check_lens(lens_radius, focal_distance)?;
        check_resolution(resolution)?;
        let shorter_side = f64::from(resolution.min_element());
        let pixel = 2.0 * (f64::from(fov).to_radians() / 2.0).tan() / shorter_side;
        let radius = f64::from(lens_radius);
        Ok(Self {
            settings: *settings,
            resolution,
            forward: forward.as_vec3(),
            pixel_x: (right * pixel).as_vec3(),
            pixel_y: (-up * pixel).as_vec3(),
            half_resolution: resolution.as_vec2() / 2.0,
            lens: (radius > 0.0).then(|| [(right * radius).as_vec3(), (up * radius).as_vec3()]),
        })
    }

    /// The settings it was built from.
    pub fn settings(&self) -> &PerspectiveSettings {
        &self.settings
    }
}

impl Camera for PerspectiveCamera {
    fn resolution(&self) -> UVec2 {
        self.resolution
    }

    fn has_lens(&self) -> bool {
        self.lens.is_some()
    }

    #[inline]
    fn generate_ray(&self, pixel: UVec2, offset: Vec2, lens: Vec2) -> Ray {
        ray_of_one(self, pixel, offset, lens)
    }

    fn generate_rays(&self, samples: &CameraSamples, rays: &mut [Ray]) {
        rays_wide(self, samples, rays);
    }

    fn pixel_cone(&self) -> Option<PixelCone> {
        Some(PixelCone::from_point(self.settings.eye, self.pixel_x.length()))
    }

    fn describe(&self) -> String {
        let PerspectiveSettings { eye, look_at, handedness, fov, .. } = self.settings;
        let PerspectiveSettings { lens_radius, focal_distance, .. } = self.settings;
        let lens = match self.has_lens() {
            true => format!("lens radius {lens_radius}, in focus at {focal_distance}"),
            false => "pinhole".into(),
        };
        format!("{eye} to {look_at}, {fov} degrees, {lens}{}", handedness.note())
    }
}

impl WideCamera for PerspectiveCamera {
    #[inline(always)]
    fn ray<F: Float>(&self, pixel: [F; 2], offset: [F; 2], lens: [F; 2]) -> [Xyz<F>; 2] {
        // In pixels from the middle of the image.
        let x = pixel[0] - F::splat(self.half_resolution.x) + offset[0];
        let y = pixel[1] - F::splat(self.half_resolution.y) + offset[1];
        let vectors = [self.settings.eye, self.forward, self.pixel_x, self.pixel_y];
        let [eye, forward, pixel_x, pixel_y] = four(|i| Xyz::splat(vectors[i]));
        let through = forward + pixel_x * x + pixel_y * y;
        let Some(axes) = self.lens else { return [eye, through.normalized()] };
        // All rays of one film point meet on the plane in focus (PBRT 3rd edition, section 6.2.3).
        let on_lens = point_on_lens(axes, lens);
        // Divided by the distance of that plane, which may be too large to multiply by.
        let d = through - on_lens / F::splat(self.settings.focal_distance);
        [eye + on_lens, d.normalized()]
    }
}

const FOV: Key<f32> = Key::new("fov", "field of view across the shorter side of the image")
    .in_unit("degrees")
    .above(0.0)
    .below(180.0)
    .default(90.0);

/// `type = "perspective"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "perspective",
    meaning: "Perspective, with a thin lens if it has one",
    keys: &[&EYE, &LOOK_AT, &UP, &HANDEDNESS, &FOV, &LENS_RADIUS, &FOCAL_DISTANCE],
    read,
};

fn read(table: &Table, resolution: UVec2) -> Result<Arc<dyn Camera>, Fault> {
    let settings = PerspectiveSettings {
        eye: table.get(&EYE)?,
        look_at: table.get(&LOOK_AT)?,
        up: table.get(&UP)?,
        handedness: table.get(&HANDEDNESS)?,
        fov: table.get(&FOV)?,
        lens_radius: table.get(&LENS_RADIUS)?,
        focal_distance: table.get(&FOCAL_DISTANCE)?,
    };
    match PerspectiveCamera::new(&settings, resolution) {
        Ok(camera) => Ok(Arc::new(camera)),
        Err(error) => Err(fault(table, error)),
    }
}
