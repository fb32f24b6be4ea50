//! [`EquirectangularCamera`]: the whole sphere of directions in one image.

use std::sync::Arc;

use glam::{UVec2, Vec2, Vec3};

use super::block::{CameraSamples, WideCamera, ray_of_one, rays_wide};
use super::error::CameraError;
use super::placement::{Axes, EYE, HANDEDNESS, LOOK_AT, UP, check_resolution, fault};
use super::traits::{Camera, Read};
use crate::geometry::{PixelCone, Ray, Xyz};
use crate::params::{Fault, Handedness, Kind, Table};
use crate::simd::{Float, four};

/// How an equirectangular camera stands. The defaults stand at the origin with +z in the middle of the image.
/// Coordinates go up to [`MAX_COORDINATE`](crate::geometry::float::MAX_COORDINATE).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquirectangularSettings {
    /// Where it stands, in world space.
    pub eye: Vec3,
    /// A point in the middle of the image, other than `eye`.
    pub look_at: Vec3,
    /// A direction that is up in the middle of the image, of any length but zero; need not be across the view, but not
    /// along it.
    pub up: Vec3,
    /// Which kind of space the world is.
    pub handedness: Handedness,
}

impl Default for EquirectangularSettings {
    fn default() -> Self {
        Self { eye: Vec3::ZERO, look_at: Vec3::Z, up: Vec3::Y, handedness: Handedness::Left }
    }
}

/// A camera that sees in all directions: a panorama, or an environment map (PBRT 3rd edition, section 6.3).
///
/// With x from 0 at the left to 1 at the right of the image, and y from 0 at its top to 1 at its bottom, the direction is
/// sin θ (cos φ forward + sin φ right) + cos θ up, where φ = 2π (x - 1/2) and θ = π y. `look_at` is in the middle, where
/// φ = 0 and θ = π/2. The left and right edge both look backwards, the upper edge is the direction up, and the lower
/// one down. Up is the setting made perpendicular to the view. A pixel stands for a solid angle in proportion to sin θ;
/// pixels are as wide as high at the horizon if the image is twice as wide as high.
#[doc(alias = "panorama")]
#[doc(alias = "360")]
#[doc(alias = "spherical camera")]
#[doc(alias = "environment camera")]
#[derive(Clone, Copy, Debug)]
pub struct EquirectangularCamera {
    settings: EquirectangularSettings,
    resolution: UVec2,
    right: Vec3,
    up: Vec3,
    forward: Vec3,
}

impl EquirectangularCamera {
    /// A camera for images of `resolution` pixels.
    ///
    /// # Errors
    /// If a setting is out of its range, or if the settings leave open where the camera looks.
    pub fn new(settings: &EquirectangularSettings, resolution: UVec2) -> Result<Self, CameraError> {
        let EquirectangularSettings { eye, look_at, up, handedness } = *settings;
        let Axes { right, up, forward } = Axes::new(eye, look_at, up, handedness)?;
        check_resolution(resolution)?;
        let [right, up, forward] = [right, up, forward].map(|axis| axis.as_vec3());
        Ok(Self { settings: *settings, resolution, right, up, forward })
    }

    /// The settings it was built from.
    pub fn settings(&self) -> &EquirectangularSettings {
        &self.settings
    }
}

impl WideCamera for EquirectangularCamera {
    #[inline(always)]
    fn ray<F: Float>(&self, pixel: [F; 2], offset: [F; 2], _lens: [F; 2]) -> [Xyz<F>; 2] {
        let resolution = self.resolution.as_vec2();
        let (columns, rows) = (F::splat(resolution.x), F::splat(resolution.y));
        // In turns. A wide filter may ask for points beyond the image: beyond a pole, the other side comes down again.
        let (half, one) = (F::splat(0.5), F::splat(1.0));
        let phi = (pixel[0] - columns * half + offset[0]) / columns;
        let theta = half * (pixel[1] + offset[1]) / rows;
        // By its magnitude, so that left and right are alike to the bit.
        let ([cos_phi, sin_phi], [cos_theta, sin_theta]) = (circle(phi.abs()), circle(theta));
        let vectors = [self.settings.eye, self.right, self.up, self.forward];
        let [eye, right, up, forward] = four(|i| Xyz::splat(vectors[i]));
        let across = forward * cos_phi + right * (one.copysign(phi) * sin_phi);
        [eye, across * sin_theta + up * cos_theta]
    }
}

impl Camera for EquirectangularCamera {
    fn resolution(&self) -> UVec2 {
        self.resolution
    }

    fn has_lens(&self) -> bool {
        false
    }

    fn generate_ray(&self, pixel: UVec2, offset: Vec2, lens: Vec2) -> Ray {
        ray_of_one(self, pixel, offset, lens)
    }

    fn generate_rays(&self, samples: &CameraSamples, rays: &mut [Ray]) {
        rays_wide(self, samples, rays);
    }

    fn pixel_cone(&self) -> Option<PixelCone> {
        let height = std::f32::consts::PI / self.resolution.y as f32;
        Some(PixelCone::from_point(self.settings.eye, height))
    }

    fn describe(&self) -> String {
        let EquirectangularSettings { eye, look_at, handedness, .. } = self.settings;
        format!("equirectangular, {eye} to {look_at}{}", handedness.note())
    }
}

/// (cos φ, sin φ) for any number of turns.
#[inline(always)]
fn circle<F: Float>(turns: F) -> [F; 2] {
    (turns - turns.floor()).unit_circle()
}

/// `type = "equirectangular"`
pub(super) const KIND: Kind<Read> = Kind {
    name: "equirectangular",
    meaning: "All directions: a panorama, twice as wide as high",
    keys: &[&EYE, &LOOK_AT, &UP, &HANDEDNESS],
    read,
};

fn read(table: &Table, resolution: UVec2) -> Result<Arc<dyn Camera>, Fault> {
    let settings = EquirectangularSettings {
        eye: table.get(&EYE)?,
        look_at: table.get(&LOOK_AT)?,
        up: table.get(&UP)?,
        handedness: table.get(&HANDEDNESS)?,
    };
    match EquirectangularCamera::new(&settings, resolution) {
        Ok(camera) => Ok(Arc::new(camera)),
        Err(error) => Err(fault(table, error)),
    }
}
