//! Rendering: tiles on threads, progress, and an end on request.

mod passes;
mod samples;
mod tiles;
mod worker;

use std::num::NonZeroUsize;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::film::{Film, FilmContents, FilmError, Picture, Variance};
use crate::integrator::{self, Counters, Integrator};
use crate::sampling::{
    BlueNoiseSampler, IndependentSampler, Sampler, SobolSampler, StratifiedSampler,
};
use crate::scene::{SamplerKind, Scene};
use passes::Passes;
use tiles::Tiles;
use worker::Worker;

/// How to render. Apart from `spp`, `time` and `layers` none of it changes what comes out.
#[derive(Clone, Copy)]
pub struct RenderOptions<'a> {
    /// How many threads; as many as the machine has if there is no number.
    pub threads: Option<NonZeroUsize>,
    /// Columns and rows of a tile, at least 1.
    pub tile_size: u32,
    /// The most samples in each pixel, rounded down to a multiple of the sampler's sets; if there is no number, as many
    /// as the scene says, or with `time` no limit.
    pub spp: Option<u32>,
    /// Renders in passes, each with as many samples as all before it, and ends when the next one would take
    /// longer than this.
    pub time: Option<Duration>,
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
    let sampler = sampler_from_settings(scene);
    let integrator = integrator::from_settings(scene);
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
    let sets = scene.sampler().sets();
    let no_limit = if options.time.is_some() { u32::MAX } else { scene.sampler().spp };
    let mut passes = Passes::new(options.spp.unwrap_or(no_limit) / sets, options.time);
    let variance = match options.layers {
        true => Variance::suiting(sampler.is_correlated(), sets),
        false => Variance::None,
    };
    let contents = FilmContents { variance, first_hits: options.layers };
    let film = Film::new(settings.resolution, settings.window(), contents)?;
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

/// Samples that are taken of all pixels before any more are.
struct Pass<'a> {
    scene: &'a Scene,
    integrator: &'a dyn Integrator,
    sampler: &'a dyn Sampler,
    options: &'a RenderOptions<'a>,
    /// Which samples of each set.
    indices: Range<u32>,
    sets: u32,
    contents: FilmContents,
}

impl Pass<'_> {
    /// Adds the samples of all tiles to the film, and returns how many threads did so.
    fn render(&self, shared: &Mutex<(Film, Counters)>) -> Result<usize, RenderError> {
        let tiles = Tiles::new(self.scene.film().window(), self.options.tile_size);
        let pixels = AtomicU64::new(0);
        let work = || self.work(&tiles, &pixels, shared);
        let threads = self.options.threads.or_else(|| std::thread::available_parallelism().ok());
        let threads = std::thread::scope(|scope| {
            let others: Vec<_> = (1..threads.map_or(1, NonZeroUsize::get).min(tiles.count()))
                // Where the system gives no more threads, those that there are do the work.
                .map_while(|_| std::thread::Builder::new().spawn_scoped(scope, work).ok())
                .collect();
            let threads = others.len() + 1;
            let mine = work();
            // A panic in a worker, which only foreign code can cause, goes on in the caller.
            let theirs = others
                .into_iter()
                .map(|w| w.join().unwrap_or_else(|p| std::panic::resume_unwind(p)));
            theirs.fold(mine, Result::and).map(|()| threads)
        })?;
        let all = self.scene.film().window().area() as u64;
        if pixels.into_inner() < all { Err(RenderError::Cancelled) } else { Ok(threads) }
    }

    /// One thread's share: tile after tile, until there are no more.
    fn work(
        &self,
        tiles: &Tiles,
        pixels: &AtomicU64,
        shared: &Mutex<(Film, Counters)>,
    ) -> Result<(), RenderError> {
        let Self { scene, integrator, sampler, options, .. } = *self;
        let mut worker =
            Worker::new(scene, integrator, sampler, options, self.sets, self.contents)?;
        let cancelled = || options.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed));
        while !cancelled() {
            let Some(tile) = tiles.next() else { break };
            worker.render(tile, &self.indices);
            // A poisoned lock means that another worker panicked, which ends the scope anyway.
            let mut shared = shared.lock().unwrap_or_else(PoisonError::into_inner);
            let (film, counters) = &mut *shared;
            film.merge(worker.tile());
            counters.add(&worker.take_counters());
            let done = pixels.fetch_add(tile.area() as u64, Ordering::Relaxed) + tile.area() as u64;
            if let Some(progress) = options.progress {
                let samples = self.indices.start * self.sets;
                let of = scene.film().window().area() as u64;
                progress(Progress { pixels: done, of, samples, rays: counters.rays() });
            }
        }
        Ok(())
    }
}

/// The sampler that the scene's settings ask for.
fn sampler_from_settings(scene: &Scene) -> Box<dyn Sampler> {
    let settings = scene.sampler();
    let (seed, samples_per_set) = (settings.seed, settings.spp / settings.sets());
    match settings.kind {
        SamplerKind::Independent => Box::new(IndependentSampler::new(seed)),
        SamplerKind::Stratified => Box::new(StratifiedSampler::new(samples_per_set, seed)),
        SamplerKind::Sobol => Box::new(SobolSampler::new(seed)),
        SamplerKind::BlueNoise => {
            Box::new(BlueNoiseSampler::new(scene.film().resolution, samples_per_set, seed))
        }
    }
}
