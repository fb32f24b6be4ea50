//! [`ShadowRays`]: rays from surfaces to lights.

use super::pushed::Pushed;
use crate::geometry::Ray;
use crate::scene::Scene;
use crate::spectrum::Spectrum;

/// Shadow rays, each with the radiance that it adds to a sample if it is not occluded.
#[derive(Default)]
pub struct ShadowRays {
    rays: Pushed<Ray>,
    samples: Pushed<u32>,
    /// Bands, and one number of padding.
    carried: Pushed<[f32; 4]>,
    occluded: Vec<bool>,
}

impl ShadowRays {
    /// Bytes of all buffers for that many rays.
    pub(super) const fn bytes(rays: usize) -> usize {
        Pushed::<Ray>::bytes(rays)
            + Pushed::<u32>::bytes(rays)
            + Pushed::<[f32; 4]>::bytes(rays)
            + rays * size_of::<bool>()
    }

    pub(super) fn with_capacity(rays: usize) -> Self {
        Self {
            rays: Pushed::with_capacity(rays),
            samples: Pushed::with_capacity(rays),
            carried: Pushed::with_capacity(rays),
            occluded: Vec::with_capacity(rays),
        }
    }

    /// Adds a ray for the sample with this index in the wave.
    #[inline]
    pub fn push(&mut self, sample: usize, ray: Ray, radiance: Spectrum) {
        let [r, g, b] = radiance.to_array();
        self.rays.push(ray);
        self.samples.push(sample as u32);
        self.carried.push([r, g, b, 0.0]);
    }

    /// Adds those rays whose bits in the mask are set.
    #[inline(always)]
    pub(super) fn push_some(
        &mut self,
        mask: u32,
        samples: &[u32],
        rays: &[[f32; 8]],
        carried: &[[f32; 4]],
    ) {
        self.rays.push_some(mask, bytemuck::cast_slice(rays));
        self.samples.push_some(mask, samples);
        self.carried.push_some(mask, carried);
    }

    /// Traces all rays, adds the radiance of those that are not occluded, and returns the number of rays.
    pub fn trace(&mut self, scene: &Scene, radiance: &mut [Spectrum]) -> u64 {
        let rays = self.rays.as_slice();
        self.occluded.resize(rays.len(), false);
        scene.occluded(rays, &mut self.occluded);
        let count = rays.len() as u64;
        let carried = self.carried.as_slice();
        for ((&sample, &[r, g, b, _]), &occluded) in
            self.samples.as_slice().iter().zip(carried).zip(&self.occluded)
        {
            let carried = if occluded { Spectrum::BLACK } else { Spectrum::new(r, g, b) };
            radiance[sample as usize] += carried;
        }
        self.rays.clear();
        self.samples.clear();
        self.carried.clear();
        count
    }
}
