//! [`RenderOptions`] and [`Rendered`]: what goes into a render beside scene, view and settings, and what comes out.

use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use super::settings::SettingsError;
use crate::film::FilmError;
use crate::image::Picture;
use crate::integrator::Counters;

/// How to render. Apart from `spp`, `time`, `layers` and `cancel` none of it changes what comes out.
#[derive(Clone, Copy)]
pub struct RenderOptions<'a> {
    /// How many threads; as many as the machine has if there is no number.
    pub threads: Option<NonZeroUsize>,
    /// Columns and rows of a tile, at least 1.
    pub tile_size: u32,
    /// Samples in each pixel, at least 1, in place of the settings'. With `time` it is the most, and without a number
    /// there is no limit.
    pub spp: Option<u32>,
    /// Renders in passes, each with as many samples as all before it, and in the time that is left smaller ones, until
    /// none is likely to end in time. How many samples that makes depends on the machine. `Duration::MAX` and a number
    /// of samples give passes without a limit in time. On `wasm32-unknown-unknown`, which has no clock, there is none.
    pub time: Option<Duration>,
    /// Whether to keep normal, depth and albedo of the first hits, the number of samples, and the variance of each
    /// pixel.
    pub layers: bool,
    /// Called after every tile, by the thread that rendered it, while the other threads cannot hand in
    /// theirs: it should be quick.
    pub progress: Option<&'a (dyn Fn(Progress) + Sync)>,
    /// Called after every pass, by the thread that called [`render`](super::render), with the picture so far. Without `time` there is
    /// one pass. The next one begins when it returns.
    pub on_pass: Option<&'a (dyn Fn(&Rendered) + Sync)>,
    /// Ends the render early once it is true. It is looked at before each wave of about a thousand samples.
    pub cancel: Option<&'a AtomicBool>,
}

impl Default for RenderOptions<'_> {
    fn default() -> Self {
        Self {
            threads: None,
            tile_size: 16,
            spp: None,
            time: None,
            layers: false,
            progress: None,
            on_pass: None,
            cancel: None,
        }
    }
}

/// How far a render is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Pixels that are done in this pass.
    pub pixels: u64,
    /// Pixels that there are.
    pub of: u64,
    /// Samples in each pixel that earlier passes took; with [`RenderOptions::time`] there are several.
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
    /// What was done, with the samples that a cancelled render took but could not finish a tile with.
    pub counters: Counters,
    /// Samples of whole passes, the same number in each pixel. When a render is cancelled, pixels in tiles that its
    /// last pass finished have more; [`Layers::samples`](crate::image::Layers::samples) tells how many.
    pub samples_per_pixel: u32,
    /// Whether all samples were taken that were asked for, or that `time` allowed. It is false if the render was
    /// cancelled, and for [`RenderOptions::on_pass`], since more may come.
    pub complete: bool,
    /// Pixels without any sample, which are black. Only a render that is cancelled in its first pass leaves some.
    pub empty_pixels: u64,
    /// Samples that were left out because they were not finite.
    pub non_finite: u64,
    /// How many threads took part.
    pub threads: usize,
    /// Wall-clock time in seconds.
    pub seconds: f64,
}

/// Why there is no picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// There is not enough memory for the film.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// The settings ask for no samples.
    #[error(transparent)]
    Settings(#[from] SettingsError),
}
