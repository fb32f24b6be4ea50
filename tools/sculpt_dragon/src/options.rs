//! The command line.

use std::path::PathBuf;

use sculpt_dragon::Subject;

/// What `--help` prints.
pub const HELP: &str = "\
Sculpts a dragon, or the object that materials are shown on, from signed distance functions and
writes it as a Wavefront OBJ.

Usage: sculpt_dragon [dragon|object] [--triangles N] [-o FILE]

  dragon, object  what to sculpt (default dragon)
  --triangles N   how many triangles, 2000 to 20000000 (default 100000; object: 22000)
  -o FILE         where to write (default assets/dragon.obj; object: assets/object.obj)
  --help          this text

The same N gives the same bytes, whatever the number of threads.";

/// The numbers of triangles that can be asked for.
const RANGE: std::ops::RangeInclusive<usize> = 2_000..=20_000_000;

/// What was asked for.
#[derive(Debug, PartialEq)]
pub enum Request {
    /// The help text.
    Help,
    /// A sculpture.
    Sculpt { subject: Subject, triangles: usize, file: PathBuf },
}

/// Reads the arguments, the program's name left out. The error is a sentence for the user.
pub fn parse(mut arguments: impl Iterator<Item = String>) -> Result<Request, String> {
    let mut subject = Subject::Dragon;
    let mut triangles = None;
    let mut file = None;
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "dragon" => subject = Subject::Dragon,
            "object" => subject = Subject::Object,
            "--help" | "-h" => return Ok(Request::Help),
            "--triangles" => {
                let value = arguments.next().ok_or("--triangles needs a number after it")?;
                triangles = Some(count(&value)?);
            }
            "-o" => file = Some(arguments.next().ok_or("-o needs a file name after it")?.into()),
            other => {
                return Err(format!(
                    "unknown argument `{other}`; expected dragon, object, --triangles N, -o FILE \
                     or --help"
                ));
            }
        }
    }
    let (usual_count, usual_file) = match subject {
        Subject::Dragon => (100_000, "assets/dragon.obj"),
        Subject::Object => (22_000, "assets/object.obj"),
    };
    Ok(Request::Sculpt {
        subject,
        triangles: triangles.unwrap_or(usual_count),
        file: file.unwrap_or_else(|| usual_file.into()),
    })
}

fn count(value: &str) -> Result<usize, String> {
    let (low, high) = (RANGE.start(), RANGE.end());
    match value.parse() {
        Ok(n) if RANGE.contains(&n) => Ok(n),
        _ => Err(format!("--triangles is `{value}`; expected a whole number from {low} to {high}")),
    }
}
