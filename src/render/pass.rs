//! [`Pass`]: samples that are taken of all pixels before any more are.

use std::ops::Range;
use std::sync::atomic::Ordering;

use super::options::RenderOptions;
use super::tiles::Tiles;
use crate::clock::Stopwatch;
use crate::film::FilmContents;
use crate::integrator::Estimator;
use crate::sampling::Sampler;
use crate::scene::{Scene, View};

/// Samples that are taken of all pixels before any more are.
pub struct Pass<'a> {
    pub scene: &'a Scene,
    pub view: &'a View,
    pub estimator: &'a dyn Estimator,
    pub sampler: &'a dyn Sampler,
    pub options: &'a RenderOptions<'a>,
    /// Which samples of each pixel, counted across its sets in turn.
    pub samples: Range<u32>,
    pub sets: u32,
    pub contents: FilmContents,
    pub tiles: Tiles,
    /// Since the render began.
    pub start: Stopwatch,
    /// Seconds after `start` at which the render ends, wherever it is.
    pub deadline: Option<f64>,
}

impl Pass<'_> {
    /// Whether the caller asked for an end, or time is over.
    pub fn is_cancelled(&self) -> bool {
        self.options.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed))
            || self.deadline.is_some_and(|deadline| self.start.seconds() >= deadline)
    }
}
