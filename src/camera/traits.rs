//! The contract of cameras.

use std::sync::Arc;

use glam::{UVec2, Vec2, Vec3};

use super::CameraSamples;
use crate::geometry::Ray;
use crate::geometry::float::MAX_COORDINATE;
use crate::params::{Fault, Table};

/// How a kind of camera is read, for images of this resolution.
pub type Read = fn(&Table, UVec2) -> Result<Arc<dyn Camera>, Fault>;

/// Rays for the samples of an image.
///
/// A ray finds hits at distances from its `t_min` to its `t_max`. Its direction may have any length but zero: it is
/// normalized before the ray is traced, unless its length is 1 up to rounding. A ray is refused if its origin is not
/// finite or beyond [`MAX_COORDINATE`], if its direction is zero or not finite, or if `t_min` or `t_max` is NaN: it
/// is not traced, its sample is left out of the pixel, and
/// [`Counters::refused_camera_rays`](crate::integrator::Counters::refused_camera_rays) counts it.
pub trait Camera: Send + Sync {
    /// Columns and rows of the image that the camera was built for.
    fn resolution(&self) -> UVec2;

    /// Whether rays depend on `lens`. If not, no samples of the lens are drawn.
    fn has_lens(&self) -> bool;

    /// The ray through the point `offset` of a pixel, in pixels from its upper left corner; (1, 1) is the lower right
    /// one. A wide filter asks for points outside of `[0, 1]²`, up to 16 pixels beyond, also beyond the image.
    ///
    /// `lens` in `[0, 1)²` is a uniform sample for the point on the lens; zero if [`Camera::has_lens`] is false.
    fn generate_ray(&self, pixel: UVec2, offset: Vec2, lens: Vec2) -> Ray;

    /// Fills `rays` with [`Camera::generate_ray`] of each sample. A camera that is faster for several at a time overrides
    /// this, with bit-identical rays.
    ///
    /// # Panics
    /// May panic unless there are as many rays as samples.
    fn generate_rays(&self, samples: &CameraSamples, rays: &mut [Ray]) {
        for (i, ray) in rays.iter_mut().enumerate() {
            *ray = self.generate_ray(samples.pixel(i), samples.offset(i), samples.lens(i));
        }
    }

    /// What it is and where it stands, in one line for people.
    fn describe(&self) -> String {
        "custom".to_owned()
    }
}

impl<C: Camera + ?Sized> Camera for Arc<C> {
    fn resolution(&self) -> UVec2 {
        (**self).resolution()
    }

    fn has_lens(&self) -> bool {
        (**self).has_lens()
    }

    fn generate_ray(&self, pixel: UVec2, offset: Vec2, lens: Vec2) -> Ray {
        (**self).generate_ray(pixel, offset, lens)
    }

    fn generate_rays(&self, samples: &CameraSamples, rays: &mut [Ray]) {
        (**self).generate_rays(samples, rays);
    }

    fn describe(&self) -> String {
        (**self).describe()
    }
}

/// Makes a camera's ray fit to be traced: its direction gets unit length. Returns whether that is possible, by the
/// rules of [`Camera`].
#[inline]
pub(crate) fn prepare(ray: &mut Ray) -> bool {
    // A comparison with NaN is false.
    let in_range = ray.o.abs().cmple(Vec3::splat(MAX_COORDINATE)).all()
        && !ray.t_min.is_nan()
        && !ray.t_max.is_nan();
    let is_unit = (ray.d.length_squared() - 1.0).abs() <= UNIT_TOLERANCE;
    in_range && (is_unit || normalize(ray))
}

/// Tolerance on the squared length of a unit direction: several times the rounding error of normalizing in f32.
const UNIT_TOLERANCE: f32 = 4e-6;

#[cold]
fn normalize(ray: &mut Ray) -> bool {
    // In f64, where no square of a float overflows or vanishes.
    let Some(d) = ray.d.as_dvec3().try_normalize() else { return false };
    // What was measured in the old length stays where it is.
    let length = ray.d.as_dvec3().length();
    ray.t_min = (f64::from(ray.t_min) * length) as f32;
    ray.t_max = (f64::from(ray.t_max) * length) as f32;
    ray.d = d.as_vec3();
    true
}
