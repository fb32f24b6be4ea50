//! Shared helpers.

pub mod lobes;
pub mod meshes;
pub mod rng;
pub mod sphere;
pub mod stats;

pub use rng::Rng;

/// Runs `work` for each index below `count`, on all processors.
pub fn parallel(count: usize, work: impl Fn(usize) + Sync) {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let next = std::sync::atomic::AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                    if index >= count {
                        break;
                    }
                    work(index);
                }
            });
        }
    });
}
