//! [`Checkpoint`]: a render that can go on, and the bytes that it is stored in.

use std::io::{self, Write};
use std::ops::Range;
use std::time::Duration;

use super::rendered::{Progress, Rendered};
use super::tiles::Tiles;
use crate::clock::Stopwatch;
use crate::film::Film;
use crate::integrator::Counters;

/// What a render has: the film, and which tiles of the pass under way are in it.
pub(super) struct State {
    pub film: Film,
    pub counters: Counters,
    /// The samples that are asked for, counted across the sets of a pixel in turn.
    pub samples: Range<u32>,
    /// Whether the render has other samples, too, which another process takes.
    pub is_part: bool,
    pub sets: u32,
    pub tile_size: u32,
    /// The samples of the pass.
    pub pass: Range<u32>,
    /// For each tile, whether the film has its samples of this pass.
    pub done: Vec<bool>,
    /// Pixels of these tiles.
    pub pixels: u64,
    /// Seconds that earlier runs took.
    pub before: f64,
    /// Threads that took part.
    pub threads: usize,
    /// Since this run began.
    pub start: Stopwatch,
    /// Since the last checkpoint.
    pub saved: Stopwatch,
}

impl State {
    /// A render of these samples that has not begun.
    pub fn new(film: Film, samples: Range<u32>, is_part: bool, sets: u32, tile_size: u32) -> Self {
        let tiles = Tiles::new(film.window(), tile_size).count();
        Self {
            film,
            counters: Counters::default(),
            pass: samples.start..samples.start,
            samples,
            is_part,
            sets,
            tile_size,
            done: vec![true; tiles],
            pixels: 0,
            before: 0.0,
            threads: 0,
            start: Stopwatch::start(),
            saved: Stopwatch::start(),
        }
    }

    /// The first sample after the pass.
    pub fn next(&self) -> u32 {
        self.pass.end
    }

    /// Seconds of all runs.
    pub fn seconds(&self) -> f64 {
        self.before + self.start.seconds()
    }

    /// Whether the film has all samples of the pass.
    pub fn is_whole(&self) -> bool {
        self.done.iter().all(|done| *done)
    }

    /// How far the render is.
    pub fn progress(&self) -> Progress {
        Progress {
            pixels: self.pixels,
            total_pixels: self.film.window().area() as u64,
            samples: self.pass.start - self.samples.start,
            rays: self.counters.rays(),
        }
    }

    /// Begins a pass, or goes on with the one under way.
    pub fn begin(&mut self, pass: Range<u32>) {
        if self.pass != pass {
            (self.pass, self.pixels) = (pass, 0);
            self.done.fill(false);
        }
    }

    /// The picture so far.
    pub fn rendered(&self, complete: bool) -> Rendered {
        let whole = if self.is_whole() { self.pass.end } else { self.pass.start };
        Rendered {
            picture: if self.is_part { self.film.develop_part() } else { self.film.develop() },
            counters: self.counters,
            samples_per_pixel: whole - self.samples.start,
            complete,
            empty_pixels: self.film.empty_pixels(),
            non_finite: self.film.non_finite(),
            fireflies: self.film.fireflies(),
            threads: self.threads,
            seconds: self.seconds(),
        }
    }

    /// What has to be equal for a render to go on.
    fn identity(&self) -> [u32; 5] {
        [self.samples.start, self.samples.end, self.sets, self.tile_size, self.done.len() as u32]
    }

    fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        let Self { counters, pass, done, .. } = self;
        for number in self.identity().into_iter().chain([pass.start, pass.end]) {
            to.write_all(&number.to_le_bytes())?;
        }
        to.write_all(&self.seconds().to_le_bytes())?;
        for count in counters.to_array() {
            to.write_all(&count.to_le_bytes())?;
        }
        let done: Vec<u8> = done.iter().map(|done| u8::from(*done)).collect();
        to.write_all(&done)?;
        self.film.write_sums(to)
    }

    /// Goes on from what [`write`](Self::write) wrote.
    pub fn resume(&mut self, mut bytes: &[u8]) -> Result<(), ResumeError> {
        let from = &mut bytes;
        for expected in self.identity() {
            if u32::from_le_bytes(take(from)?) != expected {
                return Err(ResumeError::OtherSettings);
            }
        }
        let pass = u32::from_le_bytes(take(from)?)..u32::from_le_bytes(take(from)?);
        if pass.start < self.samples.start || pass.is_empty() || pass.end > self.samples.end {
            return Err(ResumeError::Damaged);
        }
        self.before = f64::from_le_bytes(take(from)?);
        let mut counts = [0; Counters::COUNT];
        for count in &mut counts {
            *count = u64::from_le_bytes(take(from)?);
        }
        let tiles = Tiles::new(self.film.window(), self.tile_size);
        self.pixels = 0;
        for (index, done) in self.done.iter_mut().enumerate() {
            *done = take::<1>(from)? == [1];
            self.pixels += if *done { tiles.window(index).area() as u64 } else { 0 };
        }
        self.film.read_sums(from).ok_or(ResumeError::Damaged)?;
        if !(bytes.is_empty() && self.before >= 0.0) {
            return Err(ResumeError::Damaged);
        }
        (self.pass, self.counters) = (pass, Counters::from_array(counts));
        Ok(())
    }
}

fn take<const N: usize>(bytes: &mut &[u8]) -> Result<[u8; N], ResumeError> {
    let (first, rest) = bytes.split_first_chunk().ok_or(ResumeError::Damaged)?;
    *bytes = rest;
    Ok(*first)
}

/// Why a render cannot go on from stored bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ResumeError {
    /// They are of a render with other settings: number of samples, sets, size of the image or of tiles, layers.
    #[error("the stored render has other samples, tiles or layers than this one")]
    OtherSettings,
    /// They are not what [`Checkpoint::write`] wrote.
    #[error("the stored render is damaged")]
    Damaged,
}

/// A render under way, at a moment when it can be stored: see [`Saving`].
pub struct Checkpoint<'a>(pub(super) &'a State);

impl Checkpoint<'_> {
    /// Writes what [`RenderOptions::resume`](super::RenderOptions::resume) needs to go on. The bytes hold for this version
    /// of the crate, the same scene, view and settings: nothing in them tells one scene from another.
    ///
    /// # Errors
    /// Those of `to`.
    pub fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        self.0.write(to)
    }

    /// The picture so far. Pixels in tiles that the pass under way has finished have more samples than others.
    pub fn rendered(&self) -> Rendered {
        self.0.rendered(false)
    }
}

/// When a render is stored, and by whom.
#[derive(Clone, Copy)]
pub struct Saving<'a> {
    /// From one time to the next; at zero, after every tile.
    pub every: Duration,
    /// Called by the thread that finished a tile. Other threads wait to deliver theirs until it returns. It is called
    /// once more when a render ends early.
    pub on_checkpoint: &'a (dyn Fn(&Checkpoint) + Sync),
}
