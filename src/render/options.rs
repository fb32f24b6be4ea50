//! [`RenderOptions`] and [`Rendered`]: what goes into a render beside scene, view and settings, and what comes out.

use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use super::checkpoint::{ResumeError, Saving};
use super::part::Part;
use super::settings::SettingsError;
use crate::film::FilmError;
use crate::image::Picture;
use crate::integrator::Counters;

/// How to render. Apart from `spp`, `time`, `layers` and `cancel` none of it changes what comes out.
#[derive(Clone, Copy)]
pub struct RenderOptions<'a> {
    /// Number of threads; `None` for as many as the machine has.
    pub threads: Option<NonZeroUsize>,
    /// Columns and rows of a tile; 0 counts as 1.
    pub tile_size: u32,
    /// Samples per pixel, at least 1, in place of the settings'. With `time` it is the maximum, and `None` means no
    /// limit.
    pub spp: Option<u32>,
    /// Limits the time, including that of runs before a checkpoint. Passes, which double, become smaller towards the end,
    /// until none is likely to fit. A pass that takes longer than expected is ended as if it were cancelled. The number of
    /// samples depends on the machine. Ignored on `wasm32-unknown-unknown`, which has no clock.
    pub time: Option<Duration>,
    /// Which of the samples are taken, for a render in parts; `None` for all. The pictures of parts have
    /// [`planes`](Picture::planes), from which [`Film::from_planes`](crate::film::Film::from_planes) and
    /// [`Film::merge`](crate::film::Film::merge) make the picture of all samples.
    pub part: Option<Part>,
    /// Whether to keep normal, depth and albedo of the first hits, the number of samples, and the variance of each
    /// pixel, from which [`Picture::standard_error`] is.
    pub layers: bool,
    /// Called after every tile by the thread that rendered it. Other threads wait to deliver theirs until it
    /// returns, so it should be quick.
    pub progress: Option<&'a (dyn Fn(Progress) + Sync)>,
    /// Called after every pass, by the thread that called [`render`](super::render), with the picture so far. Passes take as
    /// many samples as all before them: 64, 64, 128, ... or with `time` 1, 1, 2, 4, ... The next one begins when it returns.
    pub on_pass: Option<&'a (dyn Fn(&Rendered) + Sync)>,
    /// Ends the render early once it is true. It is looked at before each wave of about a thousand samples, and at each
    /// reflection.
    pub cancel: Option<&'a AtomicBool>,
    /// Stores the render from time to time.
    pub save: Option<Saving<'a>>,
    /// What [`Checkpoint::write`](super::Checkpoint::write) wrote: the render goes on from there, and gives the same picture as if it had
    /// never stopped. Scene, view, settings and options have to be the same, but for threads.
    pub resume: Option<&'a [u8]>,
}

impl Default for RenderOptions<'_> {
    fn default() -> Self {
        Self {
            threads: None,
            tile_size: 16,
            spp: None,
            time: None,
            part: None,
            layers: false,
            progress: None,
            on_pass: None,
            cancel: None,
            save: None,
            resume: None,
        }
    }
}

/// How far a render is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Pixels that are done in this pass.
    pub pixels: u64,
    /// Number of all pixels.
    pub total_pixels: u64,
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
    /// What was done, including samples of tiles that a cancelled render did not finish.
    pub counters: Counters,
    /// Samples of whole passes, the same number in each pixel. When a render is cancelled, pixels in tiles that its
    /// last pass finished have more; [`Layers::samples`](crate::image::Layers::samples) tells how many.
    pub samples_per_pixel: u32,
    /// Whether all samples were taken that were asked for, or that `time` allowed in whole passes. It is false if the render
    /// was cancelled or time ended within a pass, and for [`RenderOptions::on_pass`], since more may come.
    pub complete: bool,
    /// Pixels without any sample, which are black: those that a cancelled render did not reach, and those whose samples
    /// were all left out.
    pub empty_pixels: u64,
    /// Samples, and first hits of [`RenderOptions::layers`], that were left out because they were not finite.
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
    /// The render cannot go on from [`RenderOptions::resume`].
    #[error(transparent)]
    Resume(#[from] ResumeError),
}
