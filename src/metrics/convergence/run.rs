//! [`Run`]: time and errors of one picture.

use std::fmt;
use std::str::FromStr;

use super::super::Errors;
use crate::params::Shown;

/// Time and errors of one picture of a method.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The method's name.
    pub method: String,
    /// Samples per pixel.
    pub spp: u32,
    /// The sampler's seed.
    pub seed: u64,
    /// Seconds of set-up: the tree, the sampler, the integrator.
    pub set_up: f64,
    /// Seconds of rendering.
    pub seconds: f64,
    /// relMSE against the reference, whose own error is included.
    pub rel_mse: f64,
    /// MSE against the reference, likewise.
    pub mse: f64,
    /// Mean of (picture - reference).
    pub mean: f64,
}

/// A line of `runs.csv` that cannot be parsed. The message has the line, shortened if it is long, and what is wrong with it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{}` is not a line of runs.csv: {problem}", Shown::line(.line))]
pub struct ParseRunError {
    line: String,
    problem: String,
}

impl Run {
    /// Names of the fields, in the order in which [`Display`](fmt::Display) writes them.
    pub const HEADER: &str = "method,spp,seed,set_up_s,render_s,relmse,mse,mean";

    /// The run of a picture with these errors; `times` are the seconds of set-up and of rendering.
    pub fn new(method: &str, spp: u32, seed: u64, times: [f64; 2], errors: &Errors) -> Self {
        let [set_up, seconds] = times;
        let Errors { rel_mse, mse, mean, .. } = *errors;
        Self { method: method.into(), spp, seed, set_up, seconds, rel_mse, mse, mean }
    }
}

impl fmt::Display for Run {
    /// A line of comma-separated values. The name is quoted; numbers are written with all their digits.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { method, spp, seed, set_up, seconds, rel_mse, mse, mean } = self;
        let method = method.replace('"', "\"\"");
        write!(f, "\"{method}\",{spp},{seed},{set_up},{seconds},{rel_mse},{mse},{mean}")
    }
}

impl FromStr for Run {
    type Err = ParseRunError;

    /// Parses what [`Display`](fmt::Display) writes. There is at least one sample per pixel; all numbers are finite, and none but
    /// the mean is negative.
    fn from_str(line: &str) -> Result<Self, ParseRunError> {
        parse(line).map_err(|problem| ParseRunError { line: line.into(), problem })
    }
}

fn parse(line: &str) -> Result<Run, String> {
    let fields = || {
        let (name, numbers) = line.strip_prefix('"')?.rsplit_once('"')?;
        let numbers: Vec<&str> = numbers.strip_prefix(',')?.split(',').collect();
        let numbers = <[&str; 7]>::try_from(numbers).ok()?;
        // Each quote of a name is written twice.
        let is_quoted = !name.replace("\"\"", "").contains('"');
        is_quoted.then(|| (name.replace("\"\"", "\""), numbers))
    };
    let (method, [spp, seed, set_up, seconds, rel_mse, mse, mean]) =
        fields().ok_or_else(|| format!("expected {}", Run::HEADER))?;
    let at_least_0 = |field, text| {
        number(field, text, "a finite number of at least 0", |v: f64| v.is_finite() && v >= 0.0)
    };
    Ok(Run {
        method,
        spp: number("spp", spp, "a whole number from 1 to 4294967295", |spp| spp > 0)?,
        seed: number("seed", seed, "a whole number", |_| true)?,
        set_up: at_least_0("set_up_s", set_up)?,
        seconds: at_least_0("render_s", seconds)?,
        rel_mse: at_least_0("relmse", rel_mse)?,
        mse: at_least_0("mse", mse)?,
        mean: number("mean", mean, "a finite number", |mean: f64| mean.is_finite())?,
    })
}

fn number<T: FromStr + Copy>(
    field: &str,
    text: &str,
    expected: &str,
    is_valid: fn(T) -> bool,
) -> Result<T, String> {
    let number = text.parse().ok().filter(|number| is_valid(*number));
    number.ok_or_else(|| format!("{field} is `{}`, expected {expected}", Shown::name(text)))
}
