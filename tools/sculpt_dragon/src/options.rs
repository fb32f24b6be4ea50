//! The command line.

use std::path::PathBuf;

/// What `--help` prints.
pub const HELP: &str = "\
Sculpts a dragon from signed distance functions and writes it as a Wavefront OBJ.

Usage: sculpt_dragon [--triangles N] [-o FILE]

  --triangles N   how many triangles, 2000 to 20000000 (default 100000)
  -o FILE         where to write (default assets/dragon.obj)
  --help          this text

The same N gives the same bytes, whatever the number of threads.";

/// The numbers of triangles that can be asked for.
const RANGE: std::ops::RangeInclusive<usize> = 2_000..=20_000_000;

/// What was asked for.
#[derive(Debug, PartialEq)]
pub enum Request {
    /// The help text.
    Help,
    /// A dragon.
    Sculpt { triangles: usize, file: PathBuf },
}

/// Reads the arguments, the program's name left out. The error is a sentence for the user.
pub fn parse(mut arguments: impl Iterator<Item = String>) -> Result<Request, String> {
    let mut triangles = 100_000;
    let mut file = PathBuf::from("assets/dragon.obj");
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--help" | "-h" => return Ok(Request::Help),
            "--triangles" => {
                let value = arguments.next().ok_or("--triangles needs a number after it")?;
                triangles = count(&value)?;
            }
            "-o" => file = arguments.next().ok_or("-o needs a file name after it")?.into(),
            other => {
                return Err(format!(
                    "unknown argument `{other}`; expected --triangles N, -o FILE or --help"
                ));
            }
        }
    }
    Ok(Request::Sculpt { triangles, file })
}

fn count(value: &str) -> Result<usize, String> {
    let (low, high) = (RANGE.start(), RANGE.end());
    match value.parse() {
        Ok(n) if RANGE.contains(&n) => Ok(n),
        _ => Err(format!("--triangles is `{value}`; expected a whole number from {low} to {high}")),
    }
}
