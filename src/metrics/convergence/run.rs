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

/// A line of `runs.csv` that cannot be parsed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{}` is not a line of runs.csv: expected {header}", Shown::line(.0), header = Run::HEADER)]
pub struct ParseRunError(String);

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

    fn from_str(line: &str) -> Result<Self, ParseRunError> {
        let parse = || {
            let (name, numbers) = line.strip_prefix('"')?.rsplit_once('"')?;
            let numbers: Vec<&str> = numbers.strip_prefix(',')?.split(',').collect();
            let [spp, seed, times @ .., _, _, _] = numbers.as_slice() else { return None };
            let errors = &numbers[numbers.len() - 3..];
            let [set_up, seconds] = times else { return None };
            Some(Self {
                method: name.replace("\"\"", "\""),
                spp: spp.parse().ok()?,
                seed: seed.parse().ok()?,
                set_up: set_up.parse().ok()?,
                seconds: seconds.parse().ok()?,
                rel_mse: errors[0].parse().ok()?,
                mse: errors[1].parse().ok()?,
                mean: errors[2].parse().ok()?,
            })
        };
        parse().ok_or_else(|| ParseRunError(line.into()))
    }
}
