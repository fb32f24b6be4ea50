//! What all sweeps share: how many trials, at which parameters, and the figures by method.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::Method;

/// `effort` times the usual number of trials, but at least `least`.
pub fn trials(usual: u32, effort: f64, least: u32) -> u32 {
    ((f64::from(usual) * effort) as u32).max(least)
}

/// Two values for each power of ten, about half a decade apart: those from 10^`first` to 10^`last`.
pub fn half_decades(first: i32, last: i32) -> Vec<f64> {
    let mut values: Vec<f64> =
        (first..last).flat_map(|power| [1.0, 3.0].map(|m| m * 10.0_f64.powi(power))).collect();
    values.push(10.0_f64.powi(last));
    values
}

/// Calls `measure` with each parameter and its place, on all processors, and sorts what it gives by method. A
/// method is a name and whether it is ours.
pub fn measured<const N: usize>(
    parameters: &[f64],
    named: [(&'static str, bool); N],
    measure: impl Fn(usize, f64) -> [f64; N] + Sync,
) -> Vec<Method> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut rows = Vec::new();
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            match parameters.get(place) {
                Some(&parameter) => rows.push((place, measure(place, parameter))),
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
    rows.sort_by_key(|(place, _)| *place);
    let method = |(i, (name, is_ours)): (usize, (&'static str, bool))| Method {
        name,
        is_ours,
        values: rows.iter().map(|(_, row)| row[i]).collect(),
    };
    named.into_iter().enumerate().map(method).collect()
}

/// The larger one, where NaN is larger than all: what a method fails to compute counts.
pub fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// How far `found` is from `truth`, relative to it; infinite if it is not a number.
pub fn relative_error(found: f64, truth: f64) -> f64 {
    worse(0.0, ((found - truth) / truth).abs())
}
