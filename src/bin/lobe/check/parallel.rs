//! [`map`]: independent calls on several threads.

use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The results of `call` for each number below `count`, in order. `done` is called after each.
pub fn map<T: Send>(
    count: usize,
    threads: usize,
    done: &(dyn Fn() + Sync),
    call: &(dyn Fn(usize) -> T + Sync),
) -> Vec<T> {
    let (next, results) = (AtomicUsize::new(0), Mutex::new(Vec::with_capacity(count)));
    let work = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= count {
                break;
            }
            let result = call(index);
            results.lock().unwrap_or_else(PoisonError::into_inner).push((index, result));
            done();
        }
    };
    std::thread::scope(|scope| {
        let spawn = |_| std::thread::Builder::new().spawn_scoped(scope, work).ok();
        // This thread works too, and alone where the system gives no others.
        let _others: Vec<_> = (1..threads.min(count)).map(spawn).collect();
        work();
    });
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.sort_unstable_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}
