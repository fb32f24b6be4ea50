//! The command line.

use std::path::PathBuf;

/// What `--help` prints.
pub const HELP: &str = "\
Measures false self-hits and lost contacts of three ways to move a ray's origin off its surface.

Usage: ray_origins [-o DIR] [--rays N]

  -o DIR     the folder for ray-origins.csv, ray-origins.svg and ray-origins-plain.svg (default docs)
  --rays N   rays for each point of the chart, 100 to 10000000 (default 100000)
  --help     this text

The same N gives the same bytes.";

/// The numbers of rays that can be asked for.
const RANGE: std::ops::RangeInclusive<u32> = 100..=10_000_000;

/// What was asked for.
pub enum Request {
    /// The help text.
    Help,
    /// The measurement, with so many rays for each point, and where to write it.
    Measure { rays: u32, folder: PathBuf },
}

/// Reads the arguments, the program's name left out. The error is a sentence for the user.
pub fn parse(mut arguments: impl Iterator<Item = String>) -> Result<Request, String> {
    let mut rays = 100_000;
    let mut folder = PathBuf::from("docs");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--help" | "-h" => return Ok(Request::Help),
            "--rays" => {
                let value = arguments.next().ok_or("--rays needs a number after it")?;
                rays = value.parse().ok().filter(|n| RANGE.contains(n)).ok_or_else(|| {
                    let (low, high) = (RANGE.start(), RANGE.end());
                    format!("--rays is `{value}`; expected a whole number from {low} to {high}")
                })?;
            }
            "-o" => folder = arguments.next().ok_or("-o needs a folder after it")?.into(),
            other => {
                return Err(format!(
                    "unknown argument `{other}`; expected -o DIR, --rays N or --help"
                ));
            }
        }
    }
    Ok(Request::Measure { rays, folder })
}
