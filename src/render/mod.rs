//! Rendering: [`render`] takes a scene, a view and settings, and gives a picture. Tiles go to threads; progress is
//! reported, and a render can be cancelled without losing what it has.

mod checkpoint;
mod options;
mod part;
mod pass;
mod rendered;
mod samples;
mod schedule;
mod settings;
mod threads;
mod tiles;
mod worker;

use std::sync::{Mutex, PoisonError};

use crate::clock::Stopwatch;
use crate::film::{Film, FilmContents, Variance};
use crate::integrator::Integrator;
use crate::sampling::{SampleSets, Sampler};
use crate::scene::{Scene, View};
use checkpoint::State;
pub use checkpoint::{Checkpoint, ResumeError, Saving};
pub use options::{RenderError, RenderOptions};
pub use part::Part;
use pass::Pass;
pub use rendered::{Progress, Rendered};
use schedule::PassSchedule;
pub use settings::{RenderSettings, SamplerSettings, SettingsError};
use tiles::Tiles;

/// Renders a scene.
///
/// The picture is the same, bit by bit, for any number of threads and any size of tiles, and whether or not the render was
/// [resumed](RenderOptions::resume). With [`RenderOptions::time`] that holds for the same passes; others with as many samples
/// differ by the rounding of sums.
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
    /// Into how many independent sets they are divided in turn, at most `spp`. The variance of a correlated sampler is
    /// estimated from the means of its sets, which takes at least two sets.
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
    let Sampling { sampler, spp, sets } = sampling;
    let spp = options.spp.unwrap_or(spp);
    if spp == 0 {
        return Err(SettingsError::NoSamples.into());
    }
    let sets = sets.clamp(1, spp);
    let time = options.time.filter(|_| Stopwatch::HAS_CLOCK);
    let limit = if options.spp.is_none() && time.is_some() { u32::MAX } else { spp };
    let samples = options.part.map_or(0..limit, |part| part.samples(limit));
    if samples.is_empty() {
        return Err(SettingsError::NoSamples.into());
    }
    let variance = match options.layers {
        true => Variance::suiting(sampler.is_correlated(), sets),
        false => Variance::None,
    };
    let contents = FilmContents { variance, first_hits: options.layers };
    let film = Film::new(view.film().resolution, view.film().window(), contents)?;
    // In the picture, as channels of a file, and encoded.
    let planes = if options.part.is_some() { 3 * film.bytes() } else { 0 };
    if !usize::try_from(planes).is_ok_and(worker::is_available) {
        return Err(RenderError::OutOfMemory(planes));
    }
    let mut state =
        State::new(film, samples.clone(), options.part.is_some(), sets, options.tile_size);
    if let Some(bytes) = options.resume {
        state.resume(bytes)?;
    }
    let limit = time.map(|time| time.as_secs_f64());
    let mut schedule = PassSchedule::new(samples, state.next(), limit, state.before);
    let mut under_way = (!state.is_whole()).then(|| state.pass.clone());
    let shared = Mutex::new(state);
    let lock = || shared.lock().unwrap_or_else(PoisonError::into_inner);
    let estimator = integrator.prepare(scene);
    while let Some(samples) = under_way.take().or_else(|| schedule.next()) {
        let mut state = lock();
        state.begin(samples.clone());
        let pass = Pass {
            scene,
            view,
            estimator: &*estimator,
            sampler,
            options,
            samples,
            sets,
            contents,
            tiles: Tiles::new(view.film().window(), options.tile_size),
            start: state.start,
            deadline: limit.map(|limit| limit - state.before),
        };
        drop(state);
        let threads = pass.render(&shared);
        let mut state = lock();
        if !state.is_whole()
            && let Some(saving) = options.save
        {
            (saving.on_checkpoint)(&Checkpoint(&state));
        }
        state.threads = state.threads.max(threads?);
        if !state.is_whole() {
            return Ok(state.rendered(false));
        }
        if let Some(on_pass) = options.on_pass {
            on_pass(&state.rendered(false));
        }
    }
    Ok(lock().rendered(true))
}

/// The sampler that the settings ask for.
fn sampler_from_settings(view: &View, settings: &SamplerSettings) -> Box<dyn Sampler> {
    settings.kind.make(&SampleSets {
        resolution: view.film().resolution,
        samples_per_set: settings.spp.div_ceil(settings.sets()),
        seed: settings.seed,
    })
}
