//! Rendering: [`render`] takes a scene, a view and settings, and gives a picture. Tiles go to threads; progress is
//! reported, and a render can be cancelled without losing what it has.

mod pass;
mod samples;
mod schedule;
mod settings;
mod tiles;
mod worker;

use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use crate::clock::Stopwatch;
use crate::film::{Film, FilmContents, FilmError, Variance};
use crate::image::Picture;
use crate::integrator::{Counters, Integrator};
use crate::sampling::{SampleSets, Sampler};
use crate::scene::{Scene, View};
use pass::Pass;
use schedule::PassSchedule;
pub use settings::{RenderSettings, SamplerSettings, SettingsError};

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
    /// Called after every pass, by the thread that called [`render`], with the picture so far. Without `time` there is
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
    /// last pass finished have more; [`Layers::samples`](crate::film::Layers::samples) tells how many.
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

/// Renders a scene.
///
/// The picture is the same, bit by bit, for any number of threads and any size of tiles. With
/// [`RenderOptions::time`] that holds for the same number of samples.
///
/// # Errors
/// If there is not enough memory for the film, or if the settings ask for no samples. A cancelled render is no error:
/// see [`Rendered::complete`].
///
/// ```
/// use lobe::scene::{FilmSettings, View};
/// use lobe::{PerspectiveSettings, RenderOptions, Scene, Spectrum, render};
///
/// let scene = Scene::builder().build()?;
/// let view = View::perspective(&PerspectiveSettings::default(), FilmSettings::new(8, 6))?;
/// let rendered = render(&scene, &view, &RenderSettings::default(), &RenderOptions::default())?;
/// assert_eq!(rendered.picture.color, vec![Spectrum::BLACK; 48]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn render(
    scene: &Scene,
    view: &View,
    settings: &RenderSettings,
    options: &RenderOptions,
) -> Result<Rendered, RenderError> {
    let spp = options.spp.unwrap_or(settings.sampler.spp);
    let samples = SamplerSettings { spp, ..settings.sampler };
    samples.check()?;
    let sampler = sampler_from_settings(view, &samples);
    let sampling = Sampling { sampler: &*sampler, spp, sets: samples.sets() };
    render_with(scene, view, &*settings.integrator, sampling, options)
}

/// A sampler, and how many of its samples a pixel gets.
#[derive(Clone, Copy)]
pub struct Sampling<'a> {
    /// Where the samples come from.
    pub sampler: &'a dyn Sampler,
    /// Samples in each pixel, at least 1; [`RenderOptions::spp`] takes its place.
    pub spp: u32,
    /// Into how many independent sets they are divided, at most `spp`, of `spp / sets` samples each. The variance of a
    /// correlated sampler is estimated from the means of its sets, of which that takes at least two.
    pub sets: u32,
}

impl<'a> Sampling<'a> {
    /// `spp` samples in one set.
    pub fn new(sampler: &'a dyn Sampler, spp: u32) -> Self {
        Self { sampler, spp, sets: 1 }
    }
}

/// Renders a scene by an integrator and a sampler of the caller's.
///
/// # Errors
/// As for [`render`].
pub fn render_with(
    scene: &Scene,
    view: &View,
    integrator: &dyn Integrator,
    sampling: Sampling,
    options: &RenderOptions,
) -> Result<Rendered, RenderError> {
    let start = Stopwatch::start();
    let Sampling { sampler, spp, sets } = sampling;
    let spp = options.spp.unwrap_or(spp);
    if spp == 0 {
        return Err(SettingsError::NoSamples.into());
    }
    let sets = sets.clamp(1, spp);
    let time = options.time.filter(|_| Stopwatch::HAS_CLOCK);
    let limit = if options.spp.is_none() && time.is_some() { u32::MAX } else { spp };
    let mut schedule = PassSchedule::new(limit / sets, time);
    let variance = match options.layers {
        true => Variance::suiting(sampler.is_correlated(), sets),
        false => Variance::None,
    };
    let contents = FilmContents { variance, first_hits: options.layers };
    let (resolution, window) = (view.film().resolution, view.film().window());
    let area = window.area() as u64;
    let shared = Mutex::new((Film::new(resolution, window, contents)?, Counters::default()));
    let (mut samples_per_pixel, mut empty_pixels, mut threads) = (0, area, 0);
    let so_far = |samples_per_pixel, empty_pixels, threads, complete| {
        let shared = shared.lock().unwrap_or_else(PoisonError::into_inner);
        let (film, counters) = &*shared;
        Rendered {
            picture: film.develop(),
            counters: *counters,
            samples_per_pixel,
            complete,
            empty_pixels,
            non_finite: film.non_finite(),
            threads,
            seconds: start.seconds(),
        }
    };
    let estimator = integrator.prepare(scene);
    let estimator = &*estimator;
    while let Some(indices) = schedule.next() {
        let samples = indices.end * sets;
        let pass = Pass { scene, view, estimator, sampler, options, indices, sets, contents };
        let end = pass.render(&shared)?;
        threads = threads.max(end.threads);
        empty_pixels = empty_pixels.min(area - end.pixels);
        if end.pixels < area {
            return Ok(so_far(samples_per_pixel, empty_pixels, threads, false));
        }
        samples_per_pixel = samples;
        if let Some(on_pass) = options.on_pass {
            on_pass(&so_far(samples_per_pixel, empty_pixels, threads, false));
        }
    }
    Ok(so_far(samples_per_pixel, empty_pixels, threads, true))
}

/// The sampler that the settings ask for.
fn sampler_from_settings(view: &View, settings: &SamplerSettings) -> Box<dyn Sampler> {
    settings.kind.make(&SampleSets {
        resolution: view.film().resolution,
        samples_per_set: settings.spp / settings.sets(),
        seed: settings.seed,
    })
}
