//! Shared by all sweeps: numbers of trials, parameters, parallel measurement, and errors.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::sweep::Method;

/// `effort` times the default number of trials, but at least `least`.
pub fn trials(usual: u32, effort: f64, least: u32) -> u32 {
    ((f64::from(usual) * effort) as u32).max(least)
}

/// 1 and 3 times each power of ten, from 10^`first` to 10^`last`.
pub fn half_decades(first: i32, last: i32) -> Vec<f64> {
    let mut values: Vec<f64> =
        (first..last).flat_map(|power| [1.0, 3.0].map(|m| m * 10.0_f64.powi(power))).collect();
    values.push(10.0_f64.powi(last));
    values
}

/// Calls `measure` with the index and the value of each parameter, on all processors, and collects the results by
/// method. A method is given by its name and whether it is ours.
pub fn measured<const N: usize>(
    parameters: &[f64],
    named: [(&'static str, bool); N],
    measure: impl Fn(usize, f64) -> [f64; N] + Sync,
) -> Vec<Method> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut rows = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            match parameters.get(index) {
                Some(&parameter) => rows.push((index, measure(index, parameter))),
                None => return rows,
            }
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let mut rows = std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
        let mut rows = work();
        for other in others {
            match other.join() {
                Ok(more) => rows.extend(more),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        rows
    });
    rows.sort_by_key(|(index, _)| *index);
    let method = |(i, (name, is_ours)): (usize, (&'static str, bool))| Method {
        name,
        is_ours,
        values: rows.iter().map(|(_, row)| row[i]).collect(),
    };
    named.into_iter().enumerate().map(method).collect()
}

/// The larger of two errors. NaN counts as infinite.
pub fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// Relative error of `found`; infinite if that is NaN.
pub fn relative_error(found: f64, truth: f64) -> f64 {
    worse(0.0, ((found - truth) / truth).abs())
}
