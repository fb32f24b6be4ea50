//! How a [`Pass`] is rendered: its tiles go to as many threads as there are.

use std::num::NonZeroUsize;
use std::sync::{Mutex, MutexGuard, PoisonError, mpsc};

use super::checkpoint::{Checkpoint, State};
use super::options::RenderError;
use super::pass::Pass;
use super::worker::{Worker, is_available};
use crate::clock::Stopwatch;

impl Pass<'_> {
    /// Adds the samples of all tiles to the film, or of those that were finished when the render was cancelled. Returns
    /// how many threads took part.
    pub fn render(&self, shared: &Mutex<State>) -> Result<usize, RenderError> {
        let cancelled = || self.is_cancelled();
        let threads = self.options.threads.or_else(|| std::thread::available_parallelism().ok());
        let most = threads.map_or(1, NonZeroUsize::get).min(self.tiles.count());
        std::thread::scope(|scope| {
            let mut mine = Worker::new(self, &cancelled)?;
            let mut others = Vec::new();
            // Where the system gives no more memory or threads, those that there are do the work. One starts after the
            // other, since only a running thread has what it takes from the system.
            while others.len() + 1 < most && is_available(MEMORY) {
                let (started, has_started) = mpsc::channel();
                let work = move || {
                    let worker = Worker::new(self, &cancelled);
                    let _ = started.send(worker.is_ok());
                    worker.into_iter().for_each(|mut worker| self.work(&mut worker, shared));
                };
                let Ok(other) = std::thread::Builder::new().spawn_scoped(scope, work) else {
                    break;
                };
                others.push(other);
                if has_started.recv() != Ok(true) {
                    break;
                }
            }
            let threads = others.len() + 1;
            self.work(&mut mine, shared);
            for other in others {
                // A panic in a worker, which only foreign code can cause, goes on in the caller.
                other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            }
            Ok(threads)
        })
    }

    /// One thread's share: tile after tile, until there are no more or the render is cancelled.
    fn work(&self, worker: &mut Worker, shared: &Mutex<State>) {
        while !self.is_cancelled()
            && let Some((index, tile)) = self.tiles.next()
        {
            // Only this thread changes the mark of this tile.
            if lock(shared).done[index] {
                continue;
            }
            let is_whole = worker.render(tile);
            let mut state = lock(shared);
            state.counters.add(&worker.take_counters());
            if !is_whole {
                break;
            }
            state.film.merge(worker.tile());
            state.done[index] = true;
            state.pixels += tile.area() as u64;
            if let Some(progress) = self.options.progress {
                progress(state.progress());
            }
            if let Some(saving) = self.options.save
                && state.saved.seconds() >= saving.every.as_secs_f64()
            {
                (saving.on_checkpoint)(&Checkpoint(&state));
                state.saved = Stopwatch::start();
            }
        }
    }
}

/// Address space that a thread may take from the system, beside its worker's buffers: a stack of 2 MiB, and 128 MiB that
/// glibc reserves for a thread's allocations.
const MEMORY: usize = 160 << 20;

/// A poisoned lock means that another worker panicked, which ends the scope anyway.
fn lock(shared: &Mutex<State>) -> MutexGuard<'_, State> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}
