//! Wall-clock time, for reports and time limits.
//!
//! `wasm32-unknown-unknown` has no clock: `Instant::now` panics there. A [`Stopwatch`] stays at zero instead, so that
//! scenes build and render. Only this file asks the system for the time.

use std::time::Instant;

/// Measures wall-clock time from its start; always zero where there is no clock.
#[derive(Clone, Copy)]
pub struct Stopwatch(Option<Instant>);

impl Stopwatch {
    /// Whether this target has a clock.
    pub const HAS_CLOCK: bool = !cfg!(all(target_family = "wasm", target_os = "unknown"));

    /// Starts now.
    pub fn start() -> Self {
        Self(Self::HAS_CLOCK.then(Instant::now))
    }

    /// Seconds since the start.
    pub fn seconds(self) -> f64 {
        self.0.map_or(0.0, |start| start.elapsed().as_secs_f64())
    }
}
