//! [`FirstHits`]: sums of what a pixel's camera rays hit first.

use glam::Vec3;

use super::pixel_sum::add;
use super::stored::Stored;
use crate::image::Layers;
use crate::spectrum::Spectrum;

/// Sums over the samples of a pixel that hit something.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FirstHits {
    normal: [f64; 3],
    depth: f64,
    albedo: [f64; 3],
    pub hits: u32,
}

impl Stored for FirstHits {
    fn store(&self, to: &mut Vec<u8>) {
        self.normal.store(to);
        self.depth.store(to);
        self.albedo.store(to);
        self.hits.store(to);
    }

    fn restore(from: &mut &[u8]) -> Option<Self> {
        Some(Self {
            normal: Stored::restore(from)?,
            depth: f64::restore(from)?,
            albedo: Stored::restore(from)?,
            hits: u32::restore(from)?,
        })
    }
}

impl FirstHits {
    #[inline]
    pub fn add(&mut self, normal: Vec3, depth: f32, albedo: Spectrum) {
        add(&mut self.normal, normal.to_array().map(f64::from));
        add(&mut self.albedo, albedo.to_array().map(f64::from));
        self.depth += f64::from(depth);
        self.hits += 1;
    }

    pub fn merge(&mut self, other: &Self) {
        add(&mut self.normal, other.normal);
        add(&mut self.albedo, other.albedo);
        self.depth += other.depth;
        self.hits += other.hits;
    }

    /// The means of each pixel; `samples` are those of the pixels, hits or not.
    pub fn develop(pixels: &[Self], samples: impl Iterator<Item = u32>) -> Layers {
        let mean = |sum: [f64; 3], count: u32| sum.map(|s| (s / f64::from(count.max(1))) as f32);
        Layers {
            normal: pixels.iter().map(|p| mean(p.normal, p.hits).into()).collect(),
            depth: pixels.iter().map(|p| (p.depth / f64::from(p.hits.max(1))) as f32).collect(),
            albedo: pixels.iter().map(|p| mean(p.albedo, p.hits).into()).collect(),
            samples: samples.collect(),
        }
    }
}
