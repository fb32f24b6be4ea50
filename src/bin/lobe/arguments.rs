//! Arguments that several subcommands share, other than those of [`scene`](crate::scene).

use std::num::NonZeroUsize;
use std::time::Duration;

use clap::{Args, value_parser};

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

/// Parses a time in seconds.
pub fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().and_then(|s| Duration::try_from_secs_f64(s).ok());
    seconds.filter(|time| !time.is_zero()).ok_or("expected a number of seconds above 0".into())
}
