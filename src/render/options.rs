//! [`RenderOptions`]: what goes into a render beside scene, view and settings.

use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use super::checkpoint::{ResumeError, Saving};
use super::part::Part;
use super::rendered::{Progress, Rendered};
use super::settings::SettingsError;
use crate::film::FilmError;

/// How to render. Apart from `spp`, `time`, `part`, `layers` and `cancel` none of it changes what comes out.
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
    /// [`planes`](crate::image::Picture::planes), from which [`Film::from_planes`](crate::film::Film::from_planes) and
    /// [`Film::merge`](crate::film::Film::merge) make the picture of all samples.
    pub part: Option<Part>,
    /// Whether to keep normal, depth and albedo of the first hits, the number of samples, and the variance of each
    /// pixel, from which [`Picture::standard_error`](crate::image::Picture::standard_error) is.
    pub layers: bool,
    /// Called after every tile by the thread that rendered it. Other threads wait to deliver theirs until it
    /// returns, so it should be quick.
    pub progress: Option<&'a (dyn Fn(Progress) + Sync)>,
    /// Called after every pass, by the thread that called [`render`](super::render), with the picture so far. Passes take as
    /// many samples as all before them: 64, 64, 128, ... or with `time`, or 1024 samples and more, 1, 1, 2, 4, ... The next one begins when it returns.
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

/// Why there is no picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// There is not enough memory for the film.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// There is not enough memory for the buffers of a thread, or for the sums that the picture of a part holds.
    #[error("rendering needs {} MiB of memory more, which are not available", .0.div_ceil(1 << 20))]
    OutOfMemory(u64),
    /// The settings ask for no samples.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// The render cannot go on from [`RenderOptions::resume`].
    #[error(transparent)]
    Resume(#[from] ResumeError),
}
