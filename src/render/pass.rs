//! [`Pass`]: all tiles once, on as many threads as there are.

use std::num::NonZeroUsize;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use super::tiles::Tiles;
use super::worker::Worker;
use super::{Progress, RenderError, RenderOptions};
use crate::film::{Film, FilmContents};
use crate::integrator::{Counters, Estimator};
use crate::sampling::Sampler;
use crate::scene::Scene;

/// Samples that are taken of all pixels before any more are.
pub struct Pass<'a> {
    pub scene: &'a Scene,
    pub estimator: &'a dyn Estimator,
    pub sampler: &'a dyn Sampler,
    pub options: &'a RenderOptions<'a>,
    /// Which samples of each set.
    pub indices: Range<u32>,
    pub sets: u32,
    pub contents: FilmContents,
}

impl Pass<'_> {
    /// Adds the samples of all tiles to the film, and returns how many threads did so.
    pub fn render(&self, shared: &Mutex<(Film, Counters)>) -> Result<usize, RenderError> {
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
        let Self { scene, estimator, sampler, options, .. } = *self;
        let mut worker = Worker::new(scene, estimator, sampler, options, self.sets, self.contents)?;
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
