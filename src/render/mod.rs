//! Rendering: [`render`] takes a scene, a view and settings, and gives a picture. Tiles go to threads; progress is
//! reported, and a render can be cancelled without losing what it has.

mod options;
mod pass;
mod samples;
mod schedule;
mod settings;
mod threads;
mod tiles;
mod worker;

use std::sync::{Mutex, PoisonError};

use crate::clock::Stopwatch;
use crate::film::{Film, FilmContents, Variance};
use crate::integrator::{Counters, Integrator};
use crate::sampling::{SampleSets, Sampler};
use crate::scene::{Scene, View};
pub use options::{Progress, RenderError, RenderOptions, Rendered};
use pass::Pass;
use schedule::PassSchedule;
pub use settings::{RenderSettings, SamplerSettings, SettingsError};

/// Renders a scene.
///
/// The picture is the same, bit by bit, for any number of threads and any size of tiles. With
/// [`RenderOptions::time`] that holds for the same passes; others with as many samples differ by the rounding of sums.
///
/// # Errors
/// If there is not enough memory for the film, or if the settings ask for no samples. A cancelled render is no error:
/// see [`Rendered::complete`].
///
/// ```
/// use lobe::scene::{FilmSettings, View};
/// use lobe::{PerspectiveSettings, RenderOptions, RenderSettings, Scene, Spectrum, render};
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
    /// correlated sampler is estimated from the means of its sets, which takes at least two sets.
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
    let (mut samples_per_pixel, mut threads) = (0, 0);
    let so_far = |samples_per_pixel, threads, complete| {
        let shared = shared.lock().unwrap_or_else(PoisonError::into_inner);
        let (film, counters) = &*shared;
        Rendered {
            picture: film.develop(),
            counters: *counters,
            samples_per_pixel,
            complete,
            empty_pixels: film.empty_pixels(),
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
        if end.pixels < area {
            return Ok(so_far(samples_per_pixel, threads, false));
        }
        samples_per_pixel = samples;
        if let Some(on_pass) = options.on_pass {
            on_pass(&so_far(samples_per_pixel, threads, false));
        }
    }
    Ok(so_far(samples_per_pixel, threads, true))
}

/// The sampler that the settings ask for.
fn sampler_from_settings(view: &View, settings: &SamplerSettings) -> Box<dyn Sampler> {
    settings.kind.make(&SampleSets {
        resolution: view.film().resolution,
        samples_per_set: settings.spp / settings.sets(),
        seed: settings.seed,
    })
}
