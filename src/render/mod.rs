//! Rendering: tiles on threads, progress, and an end on request.

mod pass;
mod passes;
mod samples;
mod tiles;
mod worker;

use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::film::{Film, FilmContents, FilmError, Picture, Variance};
use crate::integrator::{self, Counters, Integrator};
use crate::sampling::{SampleSets, Sampler};
use crate::scene::{IntegratorSettings, SamplerSettings, Scene};
use pass::Pass;
use passes::Passes;

/// How to render. Apart from `spp`, `time` and `layers` none of it changes what comes out.
#[derive(Clone, Copy)]
pub struct RenderOptions<'a> {
    /// How many threads; as many as the machine has if there is no number.
    pub threads: Option<NonZeroUsize>,
    /// Columns and rows of a tile, at least 1.
    pub tile_size: u32,
    /// Samples in each pixel, in place of the scene's; with `time` the most, which without a number have no limit.
    pub spp: Option<u32>,
    /// Renders in passes, each with as many samples as all before it, and in the time that is left smaller ones, until
    /// none would end in time. How many samples that makes depends on the machine.
    pub time: Option<Duration>,
    /// Whether to keep normal, depth and albedo of the first hits, the number of samples, and the variance of each
    /// pixel.
    pub layers: bool,
    /// Told after every tile, by the thread that rendered it, while the other threads cannot hand in
    /// theirs: it should be quick.
    pub progress: Option<&'a (dyn Fn(Progress) + Sync)>,
    /// Ends the render early once it is true; looked at before each tile.
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

/// What a render gives.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// The developed film.
    pub picture: Picture,
    /// What was done.
    pub counters: Counters,
    /// Samples taken in each pixel.
    pub samples_per_pixel: u32,
    /// Samples that were left out because they were not finite.
    pub non_finite: u64,
    /// How many threads took part.
    pub threads: usize,
    /// Wall-clock time in seconds.
    pub seconds: f64,
}

/// Why there is no picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RenderError {
    /// The film cannot be had.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// The caller asked for an end.
    #[error("the render was cancelled")]
    Cancelled,
}

/// Renders a scene by its own settings.
///
/// The picture is the same, bit by bit, for any number of threads and any size of tiles. With
/// [`RenderOptions::time`] that holds for the same number of samples.
///
/// # Errors
/// If there is not enough memory for the film, or if the caller cancels the render.
///
/// ```
/// use lobe::{RenderOptions, Scene, Spectrum, render};
///
/// let scene = Scene::builder().resolution(8, 6).build()?;
/// let rendered = render(&scene, &RenderOptions::default())?;
/// assert_eq!(rendered.picture.color, vec![Spectrum::BLACK; 48]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn render(scene: &Scene, options: &RenderOptions) -> Result<Rendered, RenderError> {
    render_as(scene, scene.sampler(), scene.integrator(), options)
}

/// Renders a scene by other settings than its own.
///
/// # Errors
/// As for [`render`].
pub fn render_as(
    scene: &Scene,
    sampler: &SamplerSettings,
    integrator: &IntegratorSettings,
    options: &RenderOptions,
) -> Result<Rendered, RenderError> {
    let settings = with_options(sampler, options);
    let sampler = sampler_from_settings(scene, &settings);
    let integrator = integrator::from_settings(scene, integrator);
    render_sets(scene, &*integrator, &*sampler, &settings, options)
}

/// Renders a scene by an integrator and a sampler of the caller's. The scene's own settings of the sampler say how many
/// samples there are, and in how many sets.
///
/// # Errors
/// As for [`render`].
pub fn render_with(
    scene: &Scene,
    integrator: &dyn Integrator,
    sampler: &dyn Sampler,
    options: &RenderOptions,
) -> Result<Rendered, RenderError> {
    render_sets(scene, integrator, sampler, &with_options(scene.sampler(), options), options)
}

fn render_sets(
    scene: &Scene,
    integrator: &dyn Integrator,
    sampler: &dyn Sampler,
    settings: &SamplerSettings,
    options: &RenderOptions,
) -> Result<Rendered, RenderError> {
    let start = Instant::now();
    let film = scene.film();
    let (spp, sets) = (settings.spp, settings.sets());
    let limit = if options.spp.is_none() && options.time.is_some() { u32::MAX } else { spp };
    let mut passes = Passes::new(limit / sets, options.time);
    let variance = match options.layers {
        true => Variance::suiting(sampler.is_correlated(), sets),
        false => Variance::None,
    };
    let contents = FilmContents { variance, first_hits: options.layers };
    let film = Film::new(film.resolution, film.window(), contents)?;
    let shared = Mutex::new((film, Counters::default()));
    let mut threads = 0;
    while let Some(indices) = passes.next() {
        let pass = Pass { scene, integrator, sampler, options, indices, sets, contents };
        threads = threads.max(pass.render(&shared)?);
    }
    let (film, counters) = shared.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok(Rendered {
        picture: film.develop(),
        counters,
        samples_per_pixel: passes.done() * sets,
        non_finite: film.non_finite(),
        threads,
        seconds: start.elapsed().as_secs_f64(),
    })
}

/// The settings, with as many samples as the options say.
fn with_options(settings: &SamplerSettings, options: &RenderOptions) -> SamplerSettings {
    SamplerSettings { spp: options.spp.unwrap_or(settings.spp).max(1), ..*settings }
}

/// The sampler that the settings ask for.
fn sampler_from_settings(scene: &Scene, settings: &SamplerSettings) -> Box<dyn Sampler> {
    settings.kind.make(&SampleSets {
        resolution: scene.film().resolution,
        samples_per_set: settings.spp / settings.sets(),
        seed: settings.seed,
    })
}
