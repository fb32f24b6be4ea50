//! [`ShadowRays`]: rays from surfaces to lights.

use super::compact::push_x4;
use super::paths::Path;
use crate::geometry::Ray;
use crate::scene::Scene;
use crate::spectrum::Spectrum;

/// Shadow rays, each with the radiance that it adds to a sample if it is not occluded.
#[derive(Default)]
pub struct ShadowRays {
    rays: Vec<Ray>,
    samples: Vec<u32>,
    carried: Vec<Spectrum>,
    occluded: Vec<bool>,
}

impl ShadowRays {
    /// Bytes of all buffers for each ray.
    pub(super) const BYTES: usize =
        size_of::<Ray>() + size_of::<u32>() + size_of::<Spectrum>() + size_of::<bool>();

    pub(super) fn with_capacity(rays: usize) -> Self {
        Self {
            rays: Vec::with_capacity(rays),
            samples: Vec::with_capacity(rays),
            carried: Vec::with_capacity(rays),
            occluded: Vec::with_capacity(rays),
        }
    }

    /// Adds a ray for the sample with this index in the wave.
    #[inline]
    pub fn push(&mut self, sample: usize, ray: Ray, radiance: Spectrum) {
        self.rays.push(ray);
        self.samples.push(sample as u32);
        self.carried.push(radiance);
    }

    /// Adds the rays of those of four paths whose bits in the mask are set.
    #[inline(always)]
    pub(super) fn push_x4(
        &mut self,
        mask: u32,
        paths: [&Path; 4],
        rays: &[Ray; 4],
        radiance: &[Spectrum; 4],
    ) {
        push_x4(&mut self.rays, mask, rays);
        push_x4(&mut self.samples, mask, &paths.map(|path| path.sample));
        push_x4(&mut self.carried, mask, radiance);
    }

    /// Traces all rays, adds the radiance of those that are not occluded, and returns the number of rays.
    pub fn trace(&mut self, scene: &Scene, radiance: &mut [Spectrum]) -> u64 {
        self.occluded.resize(self.rays.len(), false);
        scene.accel().occluded(&self.rays, &mut self.occluded);
        for ((&sample, &carried), &occluded) in
            self.samples.iter().zip(&self.carried).zip(&self.occluded)
        {
            radiance[sample as usize] += if occluded { Spectrum::BLACK } else { carried };
        }
        let count = self.rays.len() as u64;
        self.rays.clear();
        self.samples.clear();
        self.carried.clear();
        count
    }
}
