//! Whether lobes and materials keep the contracts of [`BxDF`], for those of this crate and of any other.
//!
//! From several directions, each answer is compared with another way to get it: values and densities that come with samples with
//! [`f`](BxDF::f) and [`pdf`](BxDF::pdf), counts of samples with the integral of the density (chi-square), the mean weight of samples with the
//! integral of f cos θ, exchanged directions, and sample values and directions at the edge of their range.
//!
//! It does not see errors of a model: a lobe that keeps all contracts may still not look like the material it is meant for. Only
//! directions at one point are tested, and features much narrower than the density says may be missed.
//!
//! ```
//! use lobe::bxdf::{LambertianReflection, OrenNayar};
//! use lobe::check::{Options, check};
//! use lobe::Spectrum;
//!
//! let options = Options { samples: 1 << 14, ..Options::default() };
//! assert!(check(&OrenNayar::new(Spectrum::splat(0.8), 20.0), &options).findings.is_empty());
//! // A white lobe that promises to lose nothing within 0.1 %.
//! let options = Options { white: Some(1e-3), ..options };
//! assert!(check(&LambertianReflection::new(Spectrum::WHITE), &options).findings.is_empty());
//! ```

mod cells;
mod directions;
mod edges;
mod faulty;
mod reciprocity;
mod statistics;
mod subject;

use crate::bxdf::{Arena, Bsdf, BxDF};
use crate::interaction::SurfaceInteraction;
use crate::material::Material;
use crate::shape::TriangleMesh;
use glam::Vec3;

pub use directions::{Direction, Estimate};
pub use faulty::{Faulty, faulty};
use subject::{Local, Subject};

/// How a check is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Samples from each direction.
    pub samples: u32,
    /// Seed of the random numbers.
    pub seed: u64,
    /// How much of the light a lobe may lose, or add, that promises to return all of it; `None` without that promise.
    pub white: Option<f64>,
    /// Number of checks that the significance of 0.01 is shared between, by Šidák's correction: a right lobe fails one of so many checks
    /// with that probability.
    pub checks: u32,
}

impl Default for Options {
    fn default() -> Self {
        Self { samples: 1 << 18, seed: 0, white: None, checks: 1 }
    }
}

/// A contract that is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Fault {
    /// A value, density or direction is not finite, or negative.
    Invalid,
    /// A sample is on a side of the surface that the flags exclude.
    Side,
    /// The flags of a sample are not those of its event.
    Event,
    /// The value of a sample is not f at its direction.
    Value,
    /// The density of a sample is not pdf at its direction.
    Density,
    /// Samples are not distributed as the density says.
    Distribution,
    /// The density and what is rejected do not add up to 1.
    Integral,
    /// More light is returned than comes in.
    Gain,
    /// Light is lost against the promise to return all.
    Loss,
    /// The mean weight of samples is not the integral of f cos θ.
    Albedo,
    /// Exchanged directions give another value.
    Reciprocity,
}

impl Fault {
    /// All faults, in the order of their declaration.
    pub const ALL: [Self; 11] = [
        Self::Invalid,
        Self::Side,
        Self::Event,
        Self::Value,
        Self::Density,
        Self::Distribution,
        Self::Integral,
        Self::Gain,
        Self::Loss,
        Self::Albedo,
        Self::Reciprocity,
    ];

    /// Its name, in one word or two.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Invalid => "invalid",
            Self::Side => "wrong side",
            Self::Event => "wrong event",
            Self::Value => "value of samples",
            Self::Density => "density of samples",
            Self::Distribution => "distribution",
            Self::Integral => "integral of pdf",
            Self::Gain => "energy gained",
            Self::Loss => "energy lost",
            Self::Albedo => "albedo",
            Self::Reciprocity => "reciprocity",
        }
    }

    /// What was seen, in a sentence without its full stop.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Invalid => "a value, density or direction is not finite, or negative",
            Self::Side => "a sample is on a side of the surface that the flags exclude",
            Self::Event => "the flags of a sample are not those of its event",
            Self::Value => "the value of a sample is not f at its direction",
            Self::Density => "the density of a sample is not pdf at its direction",
            Self::Distribution => "samples are not distributed as pdf says (chi-square)",
            Self::Integral => "pdf and the share of samples without direction do not add up to 1",
            Self::Gain => "more light is returned than comes in",
            Self::Loss => "light is lost against the promise to return all",
            Self::Albedo => "the mean weight of samples is not the integral of f cos θ",
            Self::Reciprocity => "f changes when its directions are exchanged",
        }
    }

    /// What to look for.
    pub const fn hint(self) -> &'static str {
        match self {
            Self::Invalid => "look for 0/0 along the surface, and for roots of numbers below 0",
            Self::Side => "return None for samples on the other side",
            Self::Event => "give samples the flags of their event, not all flags of the lobe",
            Self::Value => "return f(wo, wi) of the sampled direction",
            Self::Density => "return pdf(wo, wi) of the sampled direction, of all events together",
            Self::Distribution => "pdf must be the density with which sample_f draws",
            Self::Integral => "pdf must integrate to 1 over all directions, less the share of None",
            Self::Gain => "look for a missing factor 1/eta² or a factor that counts twice",
            Self::Loss => "look for a factor below 1 that counts twice",
            Self::Albedo => "f has parts that sample_f never draws, or the other way round",
            Self::Reciprocity => "f(wo, wi) = f(wi, wo), with the factor eta² across a boundary",
        }
    }
}

/// A fault and where it was seen first.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The contract.
    pub fault: Fault,
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
}

impl Report {
    fn add(&mut self, fault: Fault, detail: impl FnOnce() -> String) {
        if self.findings.iter().all(|finding| finding.fault != fault) {
            self.findings.push(Finding { fault, detail: detail() });
        }
    }
}

/// cos θ of the directions of view.
const COSINES: [f32; 8] = [1.0, 0.7, 0.3, 0.05, 1e-4, -1.0, -0.6, -0.05];

/// Checks one lobe. A fault in debug assertions of the lobe panics.
pub fn check(lobe: &dyn BxDF, options: &Options) -> Report {
    run(&Local(lobe), options)
}

/// Checks a sum of lobes in the frame that it has.
pub fn check_bsdf(bsdf: &Bsdf, options: &Options) -> Report {
    let mut report = run(bsdf, options);
    if bsdf.rejected() > 0 {
        report.add(Fault::Invalid, || format!("the Bsdf rejected {} results", bsdf.rejected()));
    }
    report
}

/// Checks the lobes of a material together, on a flat surface with uv (0.3, 0.4). What textures return elsewhere is not seen.
pub fn check_material(material: &dyn Material, options: &Options) -> Report {
    with_lobes(material, |bsdf| check_bsdf(bsdf, options))
}

/// What [`check_bsdf`] measures from the direction of this cosine, which is not 0: for curves over the angle, all of which the same random
/// numbers serve.
pub fn albedo(bsdf: &Bsdf, cos: f32, samples: u32) -> Direction {
    let mut report = Report::default();
    let options = Options { samples, ..Options::default() };
    directions::check(bsdf, 0, cos, &options, &mut report);
    report.directions.remove(0)
}

/// Runs `check` with the lobes of a material at the point of [`check_material`].
pub fn with_lobes<T>(material: &dyn Material, check: impl FnOnce(&Bsdf) -> T) -> T {
    let mesh = TriangleMesh::parallelogram(Vec3::ZERO, Vec3::X, Vec3::Y);
    let mut hit = SurfaceInteraction::on_triangle(&mesh, 0, [0.3, 0.3, 0.4], Vec3::Z);
    let arena = Arena::new();
    check(&material.compute_scattering(&mut hit, &arena))
}

fn run(subject: &dyn Subject, options: &Options) -> Report {
    let mut report = Report::default();
    edges::check(subject, &mut report);
    for (index, cos) in COSINES.into_iter().enumerate() {
        directions::check(subject, index, cos, options, &mut report);
    }
    reciprocity::check(subject, options, &mut report);
    report
}

/// The unit vector with this cosine, askew to all axes.
fn view(cos: f32) -> Vec3 {
    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
    Vec3::new(0.8 * sin, 0.6 * sin, cos)
}

/// Whether two numbers agree to a fraction, or both are as good as 0.
fn is_close(a: f32, b: f32, tolerance: f32) -> bool {
    (a - b).abs() <= tolerance * a.abs().max(b.abs()) + 1e-6
}
