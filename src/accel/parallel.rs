//! Work on several threads.

use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::thread;

/// As many threads as the system offers.
pub fn available() -> NonZeroUsize {
    thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}

/// `act` of each item, in the order of the items. They are taken one by one by so many threads, each of
/// which has a workshop of its own that serves one item after another.
pub fn map<T: Send, W, R: Send>(
    threads: NonZeroUsize,
    items: Vec<T>,
    workshop: impl Fn() -> W + Sync,
    act: impl Fn(&mut W, T) -> R + Sync,
) -> Vec<R> {
    let threads = threads.get().min(items.len());
    if threads <= 1 {
        let mut workshop = workshop();
        return items.into_iter().map(|item| act(&mut workshop, item)).collect();
    }
    let waiting = Mutex::new(items.into_iter().enumerate());
    let next = || waiting.lock().expect("no thread panics with the lock").next();
    let work = || {
        let mut workshop = workshop();
        let each = std::iter::from_fn(&next).map(|(i, item)| (i, act(&mut workshop, item)));
        each.collect::<Vec<_>>()
    };
    let mut results: Vec<(usize, R)> = thread::scope(|scope| {
        // Where the system has no more threads, those that there are do the work.
        let spawn = |_| thread::Builder::new().spawn_scoped(scope, work).ok();
        let workers: Vec<_> = (1..threads).map_while(spawn).collect();
        let mut results = work();
        for worker in workers {
            match worker.join() {
                Ok(more) => results.extend(more),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        results
    });
    results.sort_unstable_by_key(|&(i, _)| i);
    results.into_iter().map(|(_, result)| result).collect()
}
