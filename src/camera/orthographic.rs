//! [`OrthographicCamera`]: parallel rays, so that distance changes no size.

use std::sync::Arc;

use glam::{UVec2, Vec2, Vec3};

use super::block::{CameraSamples, WideCamera, ray_of_one, rays_wide};
use super::error::CameraError;
use super::placement::{
    Axes, EYE, FOCAL_DISTANCE, HANDEDNESS, LENS_RADIUS, LOOK_AT, UP, check_lens, check_resolution,
    fault, point_on_lens,
};
use super::traits::{Camera, Read};
use crate::geometry::float::{MAX_COORDINATE, MAX_COORDINATE_F64};
use crate::geometry::{PixelCone, Ray, Xyz};
use crate::params::{Fault, Handedness, Key, Kind, Table};
use crate::simd::{Float, four};

/// How an orthographic camera stands and sees. The defaults look from the origin along +z at 2 × 2 units, as PBRT's
/// screen does. Coordinates, the lens and both sides of the image go up to
/// [`MAX_COORDINATE`](crate::geometry::float::MAX_COORDINATE).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrthographicSettings {
    /// The middle of the plane that rays start from, in world space. What is behind the plane is not seen.
    pub eye: Vec3,
    /// A point in the middle of the image, other than `eye`.
    pub look_at: Vec3,
    /// A direction that is up in the image, of any length but zero; need not be across the view, but not along it.
    pub up: Vec3,
    /// Which kind of space the world is.
    pub handedness: Handedness,
    /// Scene units across the shorter side of the image, above 0.
    pub extent: f32,
    /// Radius of the lens in scene units; 0 sees everything sharply.
    pub lens_radius: f32,
    /// Distance of the plane in focus along the view, in scene units, above 0. Only a lens uses it.
    pub focal_distance: f32,
}

impl Default for OrthographicSettings {
    fn default() -> Self {
        Self {
            eye: Vec3::ZERO,
            look_at: Vec3::Z,
            up: Vec3::Y,
            handedness: Handedness::Left,
            extent: 2.0,
            lens_radius: 0.0,
            focal_distance: 1.0,
        }
    }
}

/// An orthographic camera, with a thin lens if it has one (PBRT 3rd edition, sections 6.2.1 and 6.2.3).
#[doc(alias = "parallel projection")]
#[derive(Clone, Copy, Debug)]
pub struct OrthographicCamera {
    settings: OrthographicSettings,
    resolution: UVec2,
    forward: Vec3,
    /// Along one pixel to the right and one down.
    pixel_x: Vec3,
    pixel_y: Vec3,
    /// Half the width and half the height of the lens, as vectors in the world.
    lens: Option<[Vec3; 2]>,
}

impl OrthographicCamera {
    /// A camera for images of `resolution` pixels.
    ///
    /// # Errors
    /// If a setting is out of its range, or if the settings leave open where the camera looks.
    pub fn new(settings: &OrthographicSettings, resolution: UVec2) -> Result<Self, CameraError> {
        let OrthographicSettings { eye, look_at, up, handedness, extent, .. } = *settings;
        let OrthographicSettings { lens_radius, focal_distance, .. } = *settings;
        let Axes { right, up, forward } = Axes::new(eye, look_at, up, handedness)?;
        check_resolution(resolution)?;
        let pixel = f64::from(extent) / f64::from(resolution.min_element());
        let longer_side = (pixel * f64::from(resolution.max_element())) as f32;
        if !EXTENT.limits().contains_f32(extent) {
            return Err(CameraError::Extent(extent));
        }
        if longer_side > MAX_COORDINATE {
            return Err(CameraError::LongerSide { extent, longer_side });
        }
        check_lens(lens_radius, focal_distance)?;
        let radius = f64::from(lens_radius);
        Ok(Self {
            settings: *settings,
            resolution,
            forward: forward.as_vec3(),
            pixel_x: (right * pixel).as_vec3(),
            pixel_y: (-up * pixel).as_vec3(),
            lens: (radius > 0.0).then(|| [(right * radius).as_vec3(), (up * radius).as_vec3()]),
        })
    }

    /// The settings it was built from.
    pub fn settings(&self) -> &OrthographicSettings {
        &self.settings
    }
}

impl WideCamera for OrthographicCamera {
    #[inline(always)]
    fn ray<F: Float>(&self, pixel: [F; 2], offset: [F; 2], lens: [F; 2]) -> [Xyz<F>; 2] {
        let middle = self.resolution.as_vec2() / 2.0;
        let x = pixel[0] - F::splat(middle.x) + offset[0];
        let y = pixel[1] - F::splat(middle.y) + offset[1];
        let vectors = [self.settings.eye, self.forward, self.pixel_x, self.pixel_y];
        let [eye, forward, pixel_x, pixel_y] = four(|i| Xyz::splat(vectors[i]));
        let o = eye + pixel_x * x + pixel_y * y;
        let Some(axes) = self.lens else { return [o, forward] };
        // All rays of one film point meet on the plane in focus, straight ahead of it.
        let on_lens = point_on_lens(axes, lens);
        let d = forward - on_lens / F::splat(self.settings.focal_distance);
        [o + on_lens, d.normalized()]
    }
}

impl Camera for OrthographicCamera {
    fn resolution(&self) -> UVec2 {
        self.resolution
    }

    fn has_lens(&self) -> bool {
        self.lens.is_some()
    }

    fn generate_ray(&self, pixel: UVec2, offset: Vec2, lens: Vec2) -> Ray {
        ray_of_one(self, pixel, offset, lens)
    }

    fn generate_rays(&self, samples: &CameraSamples, rays: &mut [Ray]) {
        rays_wide(self, samples, rays);
    }

    fn pixel_cone(&self) -> Option<PixelCone> {
        Some(PixelCone::parallel(self.forward, self.pixel_x.length()))
    }

    fn describe(&self) -> String {
        let OrthographicSettings { eye, look_at, handedness, extent, .. } = self.settings;
        let OrthographicSettings { lens_radius, focal_distance, .. } = self.settings;
        let lens = match self.has_lens() {
            true => format!(", lens radius {lens_radius}, in focus at {focal_distance}"),
            false => String::new(),
        };
        let note = handedness.note();
        format!("orthographic, {eye} to {look_at}, {extent} units across{lens}{note}")
    }
}

const EXTENT: Key<f32> = Key::new("extent", "scene units across the shorter side of the image")
    .above(0.0)
    .at_most(MAX_COORDINATE_F64)
    .default(2.0);

/// `type = "orthographic"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "orthographic",
    meaning: "Parallel rays: what is far away is not smaller",
    keys: &[&EYE, &LOOK_AT, &UP, &HANDEDNESS, &EXTENT, &LENS_RADIUS, &FOCAL_DISTANCE],
    read,
};

fn read(table: &Table, resolution: UVec2) -> Result<Arc<dyn Camera>, Fault> {
    let settings = OrthographicSettings {
        eye: table.get(&EYE)?,
        look_at: table.get(&LOOK_AT)?,
        up: table.get(&UP)?,
        handedness: table.get(&HANDEDNESS)?,
        extent: table.get(&EXTENT)?,
        lens_radius: table.get(&LENS_RADIUS)?,
        focal_distance: table.get(&FOCAL_DISTANCE)?,
    };
    match OrthographicCamera::new(&settings, resolution) {
        Ok(camera) => Ok(Arc::new(camera)),
        Err(error @ CameraError::LongerSide { .. }) => Err(Fault::new(table.mark(&EXTENT), error)),
        Err(error) => Err(fault(table, error)),
    }
}
