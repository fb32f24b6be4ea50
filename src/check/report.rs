//! [`Options`] of a check, and its [`Report`].

use std::fmt::{self, Display, Formatter};

use super::contract::Contract;

/// How a check is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Samples from each direction; fewer than [`LEAST_SAMPLES`](Self::LEAST_SAMPLES) are taken for so many.
    pub samples: u32,
    /// Seed of the random numbers.
    pub seed: u64,
    /// How much of the light a lobe may lose, or add, that promises to return all of it; `None` without that promise.
    pub white: Option<f64>,
    /// Number of checks that the significance of 0.01 is shared between, by Šidák's correction: a right lobe fails one of so many checks
    /// with that probability. At least 1.
    pub checks: u32,
}

impl Options {
    /// The fewest samples from which statistics tell something.
    pub const LEAST_SAMPLES: u32 = 2048;
}

impl Default for Options {
    fn default() -> Self {
        Self { samples: 1 << 18, seed: 0, white: None, checks: 1 }
    }
}

/// A broken contract and where that was seen first.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The contract.
    pub contract: Contract,
    /// The directions and numbers.
    pub detail: String,
}

/// The result of a check.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// What was measured from each direction.
    pub directions: Vec<Direction>,
    /// Contracts that are broken, each once.
    pub findings: Vec<Finding>,
    /// The largest relative difference between f of exchanged directions.
    pub reciprocity: f64,
    /// Whether light that crosses the surface does so with several indices of refraction, as in a mixture of glass and paper. Which factor
    /// η² belongs to which part of f is unknown then, so energy and reciprocity are not compared.
    pub has_several_indices: bool,
}

impl Report {
    /// Whether no contract was seen to be broken.
    pub fn is_ok(&self) -> bool {
        self.findings.is_empty()
    }

    pub(super) fn add(&mut self, contract: Contract, detail: impl FnOnce() -> String) {
        if self.findings.iter().all(|finding| finding.contract != contract) {
            self.findings.push(Finding { contract, detail: detail() });
        }
    }
}

/// A line for each finding, or "ok".
impl Display for Report {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        for Finding { contract, detail } in &self.findings {
            writeln!(f, "{}: {detail}; {}", contract.name(), contract.hint())?;
        }
        if self.is_ok() { writeln!(f, "ok") } else { Ok(()) }
    }
}

/// A measured number and its standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The number.
    pub mean: f64,
    /// Its standard error.
    pub error: f64,
}

/// What was measured from one direction. Fractions of light are those of uniform light from all around, with the factors η² of
/// refraction taken out.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    /// cos θ of wo.
    pub cos: f32,
    /// The fraction that is returned, by the mean weight of samples, per band.
    pub sampled: [Estimate; 3],
    /// Its part that is not in specular events.
    pub spread: [Estimate; 3],
    /// The same with f asked at the directions of the samples.
    pub evaluated: [f64; 3],
    /// The same as the integral of f cos θ, per band; without specular events, which have no f.
    pub integrated: [f64; 3],
    /// The fraction of light in specular events, per band.
    pub specular: [f64; 3],
    /// The integral of the density.
    pub density: f64,
    /// The fraction of sample values that give no direction.
    pub rejected: f64,
    /// The probability that samples distributed by the density fit it as badly; `None` if there are too few, as of specular lobes.
    pub p: Option<f64>,
    /// Whether f32 resolves the lobe from here. Where it does not, the density changes with the rounding of directions, and samples are not
    /// compared with integrals.
    pub is_resolved: bool,
}
