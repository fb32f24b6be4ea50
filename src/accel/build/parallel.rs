//! Work shared out to several threads.

use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::thread;

/// As many threads as the system offers.
pub fn available_threads() -> NonZeroUsize {
    thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}

/// Maps items on so many threads; results are in the order of the items. Threads take items one by one. Each has a
/// scratch value of its own, which it reuses from item to item.
pub fn map<T: Send, S, R: Send>(
    threads: NonZeroUsize,
    items: Vec<T>,
    scratch: impl Fn() -> S + Sync,
    f: impl Fn(&mut S, T) -> R + Sync,
) -> Vec<R> {
    let threads = threads.get().min(items.len());
    if threads <= 1 {
        let mut scratch = scratch();
        return items.into_iter().map(|item| f(&mut scratch, item)).collect();
    }
    let queue = Mutex::new(items.into_iter().enumerate());
    let next = || queue.lock().expect("no thread panics with the lock").next();
    let work = || {
        let mut scratch = scratch();
        let each = std::iter::from_fn(&next).map(|(i, item)| (i, f(&mut scratch, item)));
        each.collect::<Vec<_>>()
    };
    let mut results: Vec<(usize, R)> = thread::scope(|scope| {
        // If the system refuses more threads, those that there are do the work.
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
