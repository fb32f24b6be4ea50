//! Arguments that several subcommands share, other than those of [`scene`](crate::scene).

use std::num::NonZeroUsize;
use std::time::Duration;

use clap::{Args, value_parser};
use lobe::render::Part;

/// The number of threads, for subcommands that render.
#[derive(Args)]
pub struct ThreadsArgument {
    /// Number of threads, up to 1024 [default: one per processor]; pictures do not depend on it
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

impl ThreadsArgument {
    /// The number given on the command line.
    pub fn given(&self) -> Option<NonZeroUsize> {
        NonZeroUsize::new(self.threads?.into())
    }

    /// The number given on the command line, or the number of processors.
    pub fn count(&self) -> usize {
        let processors = || std::thread::available_parallelism().map_or(1, usize::from);
        self.given().map_or_else(processors, usize::from)
    }
}

/// Parses a time above 0: a number of seconds, or with the unit s, min or h.
pub fn seconds(text: &str) -> Result<Duration, String> {
    let units = [("min", 60.0), ("h", 3600.0), ("s", 1.0), ("", 1.0)];
    let in_unit = |(unit, size): (&str, f64)| {
        let number: f64 = text.strip_suffix(unit)?.parse().ok()?;
        Duration::try_from_secs_f64(size * number).ok()
    };
    let time = units.into_iter().find_map(in_unit).filter(|time| !time.is_zero());
    time.ok_or("expected a time above 0, such as 90, 90s, 1.5min or 2h".into())
}

/// Parses K/N: one of N parts, counted from 1.
pub fn part(text: &str) -> Result<Part, String> {
    let part = || {
        let (number, count) = text.split_once('/')?;
        let (number, count) = (number.parse::<u32>().ok()?, count.parse().ok()?);
        let part = Part { index: number.checked_sub(1)?, count };
        (number <= count.get()).then_some(part)
    };
    part().ok_or("expected K/N, part K of N, such as 1/8".into())
}
