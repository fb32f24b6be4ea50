//! [`CameraSamples`]: a block of samples that a camera makes rays for; and cameras that do it for several at a time.

use glam::{UVec2, Vec2};

use crate::geometry::{Ray, Xyz};
use crate::sampling::SampleId;
use crate::simd::{Block, BlockKernel, Float, InstructionSet, MAX_LANES};

/// A block of samples that a camera makes rays for.
pub struct CameraSamples<'a> {
    instruction_set: InstructionSet,
    ids: &'a [SampleId],
    offsets: &'a [Vec2],
    lens: &'a [Vec2],
}

impl<'a> CameraSamples<'a> {
    /// Samples with their points in the pixel and for the lens.
    ///
    /// # Panics
    /// Unless all slices are of one length.
    pub fn new(
        instruction_set: InstructionSet,
        ids: &'a [SampleId],
        offsets: &'a [Vec2],
        lens: &'a [Vec2],
    ) -> Self {
        assert_eq!([offsets.len(), lens.len()], [ids.len(); 2], "lengths of slices");
        Self { instruction_set, ids, offsets, lens }
    }

    /// Number of samples.
    #[inline]
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Whether there are no samples.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// The pixel of a sample.
    #[inline]
    pub fn pixel(&self, i: usize) -> UVec2 {
        self.ids[i].pixel
    }

    /// Its point in the pixel: see [`Camera::generate_ray`](super::Camera::generate_ray).
    #[inline]
    pub fn offset(&self, i: usize) -> Vec2 {
        self.offsets[i]
    }

    /// Its sample value for the lens.
    #[inline]
    pub fn lens(&self, i: usize) -> Vec2 {
        self.lens[i]
    }
}

/// A camera that makes several rays at a time.
pub(super) trait WideCamera {
    /// Origin and direction of the ray of a sample in each lane, by the arguments of
    /// [`generate_ray`](super::Camera::generate_ray).
    fn ray<F: Float>(&self, pixel: [F; 2], offset: [F; 2], lens: [F; 2]) -> [Xyz<F>; 2];
}

/// The ray of one sample.
#[inline]
pub(super) fn ray_of_one(camera: &impl WideCamera, pixel: UVec2, offset: Vec2, lens: Vec2) -> Ray {
    let [o, d] = camera.ray(pixel.as_vec2().to_array(), offset.to_array(), lens.to_array());
    Ray::new(o.into(), d.into())
}

/// The rays of a block of samples.
#[inline]
pub(super) fn rays_wide(camera: &impl WideCamera, samples: &CameraSamples, rays: &mut [Ray]) {
    samples.instruction_set.run_block(Rays { camera, samples, rays });
}

struct Rays<'a, C> {
    camera: &'a C,
    samples: &'a CameraSamples<'a>,
    rays: &'a mut [Ray],
}

impl<C: WideCamera> BlockKernel for Rays<'_, C> {
    type Output = ();

    #[inline(always)]
    fn run<F: Block>(self) {
        let Self { camera, samples: &CameraSamples { ids, offsets, lens, .. }, rays } = self;
        let (mut pixels, mut records) = ([Vec2::ZERO; MAX_LANES], [[0.0; 8]; MAX_LANES]);
        let (mut last_offsets, mut last_lens) = ([Vec2::ZERO; MAX_LANES], [Vec2::ZERO; MAX_LANES]);
        let lanes = F::LANES;
        let blocks = ids.chunks(lanes).zip(offsets.chunks(lanes)).zip(lens.chunks(lanes));
        for (((ids, mut offsets), mut lens), rays) in blocks.zip(rays.chunks_mut(lanes)) {
            for (pixel, id) in pixels.iter_mut().zip(ids) {
                *pixel = id.pixel.as_vec2();
            }
            let len = ids.len();
            if len < lanes {
                last_offsets[..len].copy_from_slice(offsets);
                last_lens[..len].copy_from_slice(lens);
                (offsets, lens) = (&last_offsets, &last_lens);
            }
            let (pixel, offset) = (F::load_pairs(&pixels), F::load_pairs(offsets));
            let [o, d] = camera.ray(pixel, offset, F::load_pairs(lens));
            let (zero, infinity) = (F::splat(0.0), F::splat(f32::INFINITY));
            let rows = [o.x, o.y, o.z, zero, d.x, d.y, d.z, infinity];
            if len == lanes {
                F::scatter(rows, bytemuck::cast_slice_mut(rays));
            } else {
                F::scatter(rows, &mut records);
                rays.copy_from_slice(bytemuck::cast_slice(&records[..len]));
            }
        }
    }
}
