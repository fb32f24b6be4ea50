//! The contract of cameras.

use std::sync::Arc;

use glam::{UVec2, Vec2};

use super::CameraSamples;
use crate::geometry::float::MAX_COORDINATE;
use crate::geometry::{PixelCone, Ray};
use crate::params::{Fault, Table};
use crate::simd::{
    Block, BlockKernel, Float, InstructionSet, LaneMask, ROW, RowMask, groups, indices,
    lanes_within,
};

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

    /// How far apart the rays of neighbouring pixels are, about, for textures that filter; `None` if that is not known: then they do not.
    fn pixel_cone(&self) -> Option<PixelCone> {
        None
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

    fn pixel_cone(&self) -> Option<PixelCone> {
        (**self).pixel_cone()
    }

    fn describe(&self) -> String {
        (**self).describe()
    }
}

/// Makes a camera's rays fit to be traced: their directions get unit length. Calls `refuse` for each for which that is
/// impossible by the rules of [`Camera`], with its index.
pub(crate) fn prepare(
    instruction_set: InstructionSet,
    rays: &mut [Ray],
    mut refuse: impl FnMut(usize, &mut Ray),
) {
    for (block, rays) in rays.chunks_mut(ROW).enumerate() {
        for i in indices(instruction_set.run_block(Unfit { rays })) {
            let ray = &mut rays[i];
            let [is_in_range, _] = checks(bytemuck::cast::<Ray, [f32; 8]>(*ray));
            if !(is_in_range && normalize(ray)) {
                refuse(block * ROW + i, ray);
            }
        }
    }
}

/// Tells which rays of a block are not fit to be traced as they are.
struct Unfit<'a> {
    rays: &'a [Ray],
}

impl BlockKernel for Unfit<'_> {
    type Output = RowMask;

    #[inline(always)]
    fn run<F: Block>(self) -> RowMask {
        let rays = bytemuck::cast_slice::<Ray, [f32; 8]>(self.rays);
        let (last, mut unfit) = (rays.len() - 1, 0);
        for at in groups::<F>(rays.len()) {
            let [is_in_range, is_unit] = checks(F::gather(|lane| &rays[(at + lane).min(last)]));
            let lanes = (!(is_in_range & is_unit)).bits() & lanes_within::<F>(at, rays.len());
            unfit |= RowMask::from(lanes) << at;
        }
        unfit
    }
}

/// Whether origin and ends are valid, and whether the direction has unit length.
#[inline(always)]
fn checks<F: Float>([ox, oy, oz, t_min, dx, dy, dz, t_max]: [F; 8]) -> [F::Mask; 2] {
    let most = F::splat(MAX_COORDINATE);
    // A comparison with NaN is false.
    let is_in_range = ox.abs().le(most) & oy.abs().le(most) & oz.abs().le(most);
    let error = (dx * dx + dy * dy + dz * dz - F::splat(1.0)).abs();
    [is_in_range & t_min.eq(t_min) & t_max.eq(t_max), error.le(F::splat(UNIT_TOLERANCE))]
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
