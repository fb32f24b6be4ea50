//! Rendering: tiles on threads, progress, and an end on request.

mod tiles;
mod worker;

use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use crate::film::{Film, FilmContents, FilmError, Picture};
use crate::integrator::{self, Counters, Integrator};
use crate::sampling::{IndependentSampler, Sampler, StratifiedSampler};
use crate::scene::{SamplerKind, SamplerSettings, Scene};
use tiles::Tiles;
use worker::Worker;

/// How to render. None of it changes what comes out, apart from the layers.
#[derive(Clone, Copy)]
pub struct RenderOptions<'a> {
    /// How many threads; as many as the machine has if there is no number.
    pub threads: Option<NonZeroUsize>,
    /// Columns and rows of a tile, at least 1.
    pub tile_size: u32,
    /// Whether to keep normal, depth and albedo of the first hits.
    pub layers: bool,
    /// Told after every tile, by the thread that rendered it, while the other threads cannot hand in
    /// theirs: it should be quick.
    pub progress: Option<&'a (dyn Fn(Progress) + Sync)>,
    /// Ends the render early once it is true; looked at before each tile.
    pub cancel: Option<&'a AtomicBool>,
}

impl Default for RenderOptions<'_> {
    fn default() -> Self {
        Self { threads: None, tile_size: 16, layers: false, progress: None, cancel: None }
    }
}

/// How far a render is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Pixels that are done.
    pub pixels: u64,
    /// Pixels that there are.
    pub of: u64,
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
/// The picture is the same, bit by bit, for any number of threads and any size of tiles.
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
    let sampler = sampler_from_settings(scene.sampler());
    let integrator = integrator::from_settings(scene.integrator());
    render_with(scene, &*integrator, &*sampler, options)
}

/// Renders a scene by an integrator and a sampler of the caller's.
///
/// # Errors
/// As for [`render`].
pub fn render_with(
    scene: &Scene,
    integrator: &dyn Integrator,
    sampler: &dyn Sampler,
    options: &RenderOptions,
) -> Result<Rendered, RenderError> {
    let start = Instant::now();
    let settings = scene.film();
    let contents = FilmContents { first_hits: options.layers, ..FilmContents::default() };
    let film = Film::new(settings.resolution, settings.window(), contents)?;
    let tiles = Tiles::new(settings.window(), options.tile_size);
    let shared = Mutex::new((film, Counters::default(), 0));
    let threads = options.threads.or_else(|| std::thread::available_parallelism().ok());
    let cancelled = || options.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed));

    let work = || -> Result<(), RenderError> {
        let mut worker = Worker::new(scene, integrator, sampler, options)?;
        while !cancelled() {
            let Some(tile) = tiles.next() else { break };
            worker.render(tile);
            // A poisoned lock means that another worker panicked, which ends the scope anyway.
            let mut shared = shared.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
            let (film, counters, pixels) = &mut *shared;
            film.merge(worker.tile());
            counters.add(&worker.take_counters());
            *pixels += tile.area() as u64;
            if let Some(progress) = options.progress {
                let of = settings.window().area() as u64;
                progress(Progress { pixels: *pixels, of, rays: counters.rays() });
            }
        }
        Ok(())
    };
    let threads = std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads.map_or(1, NonZeroUsize::get).min(tiles.count()))
            // Where the system gives no more threads, those that there are do the work.
            .map_while(|_| std::thread::Builder::new().spawn_scoped(scope, work).ok())
            .collect();
        let threads = others.len() + 1;
        let mine = work();
        // A panic in a worker, which only foreign code can cause, goes on in the caller.
        let theirs =
            others.into_iter().map(|w| w.join().unwrap_or_else(|p| std::panic::resume_unwind(p)));
        theirs.fold(mine, Result::and).map(|()| threads)
    })?;

    let (film, counters, pixels) =
        shared.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
    if pixels < settings.window().area() as u64 {
        return Err(RenderError::Cancelled);
    }
    let seconds = start.elapsed().as_secs_f64();
    Ok(Rendered {
        picture: film.develop(),
        counters,
        non_finite: film.non_finite(),
        threads,
        seconds,
    })
}

/// The sampler that the settings ask for.
fn sampler_from_settings(settings: &SamplerSettings) -> Box<dyn Sampler> {
    match settings.kind {
        SamplerKind::Independent => Box::new(IndependentSampler::new(settings.seed)),
        SamplerKind::Stratified => {
            Box::new(StratifiedSampler::new(settings.spp / settings.sets(), settings.seed))
        }
        SamplerKind::Sobol | SamplerKind::BlueNoise => todo!(),
    }
}
