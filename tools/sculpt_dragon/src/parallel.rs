//! A parallel map on scoped threads whose result does not depend on their number.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;

/// `f` of every item, in the items' order.
pub fn map<T: Sync, R: Send>(items: &[T], threads: usize, f: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let (send, receive) = mpsc::channel();
    std::thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            let send = send.clone();
            let (next, f) = (&next, &f);
            scope.spawn(move || {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    // A closed channel means that the receiver is gone, and the work with it.
                    if i >= items.len() || send.send((i, f(&items[i]))).is_err() {
                        break;
                    }
                }
            });
        }
    });
    drop(send);
    let mut results: Vec<(usize, R)> = receive.into_iter().collect();
    results.sort_unstable_by_key(|r| r.0);
    results.into_iter().map(|r| r.1).collect()
}

/// Fills `out[i]` with `f(i)`, in runs of consecutive indices.
pub fn fill<R: Send>(out: &mut [R], threads: usize, f: impl Fn(usize) -> R + Sync) {
    let run = out.len().div_ceil(threads.max(1)).max(1);
    std::thread::scope(|scope| {
        for (n, chunk) in out.chunks_mut(run).enumerate() {
            let f = &f;
            scope.spawn(move || {
                for (i, slot) in chunk.iter_mut().enumerate() {
                    *slot = f(n * run + i);
                }
            });
        }
    });
}
