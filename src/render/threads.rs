//! How a [`Pass`] is rendered: its tiles go to as many threads as there are.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use super::options::Progress;
use super::pass::Pass;
use super::tiles::Tiles;
use super::worker::Worker;
use crate::film::{Film, FilmError};
use crate::integrator::Counters;

/// How far a pass came.
pub struct PassEnd {
    /// How many threads took part.
    pub threads: usize,
    /// Pixels of the tiles that were finished: all, unless the render was cancelled.
    pub pixels: u64,
}

impl Pass<'_> {
    /// Adds the samples of all tiles to the film, or of those that were finished when the render was cancelled.
    pub fn render(&self, shared: &Mutex<(Film, Counters)>) -> Result<PassEnd, FilmError> {
        let tiles = Tiles::new(self.view.film().window(), self.options.tile_size);
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
        Ok(PassEnd { threads, pixels: pixels.into_inner() })
    }

    /// One thread's share: tile after tile, until there are no more or the render is cancelled.
    fn work(
        &self,
        tiles: &Tiles,
        pixels: &AtomicU64,
        shared: &Mutex<(Film, Counters)>,
    ) -> Result<(), FilmError> {
        let mut worker = Worker::new(self)?;
        while !self.is_cancelled() {
            let Some(tile) = tiles.next() else { break };
            let is_whole = worker.render(tile);
            // A poisoned lock means that another worker panicked, which ends the scope anyway.
            let mut shared = shared.lock().unwrap_or_else(PoisonError::into_inner);
            let (film, counters) = &mut *shared;
            counters.add(&worker.take_counters());
            if !is_whole {
                break;
            }
            film.merge(worker.tile());
            let done = pixels.fetch_add(tile.area() as u64, Ordering::Relaxed) + tile.area() as u64;
            if let Some(progress) = self.options.progress {
                let samples = self.indices.start * self.sets;
                let total_pixels = self.view.film().window().area() as u64;
                progress(Progress { pixels: done, total_pixels, samples, rays: counters.rays() });
            }
        }
        Ok(())
    }
}
