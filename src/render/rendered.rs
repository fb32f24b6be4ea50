//! [`Rendered`] and [`Progress`]: what comes out of a render, in the end and on the way.

use crate::film::Fireflies;
use crate::image::Picture;
use crate::integrator::Counters;

/// How far a render is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Pixels that are done in this pass.
    pub pixels: u64,
    /// Number of all pixels.
    pub total_pixels: u64,
    /// Samples in each pixel that earlier passes took.
    pub samples: u32,
    /// Rays traced so far.
    pub rays: u64,
}

/// What a render gives, complete or not.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Rendered {
    /// The developed film. Each pixel is the mean of its own samples.
    pub picture: Picture,
    /// What was done, including samples of tiles that a cancelled render did not finish.
    pub counters: Counters,
    /// Samples of whole passes, the same number in each pixel. When a render is cancelled, pixels in tiles that its
    /// last pass finished have more; [`Layers::samples`](crate::image::Layers::samples) tells how many.
    pub samples_per_pixel: u32,
    /// Whether all samples were taken that were asked for, or that `time` allowed in whole passes. It is false if the render
    /// was cancelled or time ended within a pass, and for [`RenderOptions::on_pass`](super::RenderOptions::on_pass), since more may come.
    pub complete: bool,
    /// Pixels without any sample, which are black: those that a cancelled render did not reach, and those whose samples
    /// were all left out.
    pub empty_pixels: u64,
    /// Samples, and first hits of [`RenderOptions::layers`](super::RenderOptions::layers), that were left out because they were not finite.
    pub non_finite: u64,
    /// Pixels whose variance is mostly that of one sample; `None` without [`RenderOptions::layers`](super::RenderOptions::layers), or if there is
    /// no estimate of variances.
    pub fireflies: Option<Fireflies>,
    /// How many threads took part.
    pub threads: usize,
    /// Wall-clock time in seconds.
    pub seconds: f64,
}
