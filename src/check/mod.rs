//! Whether lobes and materials keep the contracts of [`BxDF`], for those of this crate and of any other.
//!
//! From several directions, each answer is compared with another way to get it: values and densities that come with samples with
//! [`f`](BxDF::f) and [`pdf`](BxDF::pdf), counts of samples with the integral of the density (chi-square), the mean weight of samples with the
//! integral of f cos θ, exchanged directions, and sample values and directions at the edge of their range.
//!
//! `rho_hd` and `rho_hh` are not looked at. It does not see errors of a model: a lobe that keeps all contracts may still not look
//! like the material it is meant for. Only
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
mod contract;
mod directions;
mod edges;
mod event_numbers;
mod faulty;
mod reciprocity;
mod report;
pub mod statistics;
mod subject;

use crate::bxdf::{Arena, Bsdf, BxDF};
use crate::interaction::SurfaceInteraction;
use crate::material::Material;
use crate::shape::TriangleMesh;
use glam::Vec3;

pub use contract::Contract;
pub use faulty::{Faulty, faulty};
pub use report::{Direction, Estimate, Finding, Options, Report};
use subject::{COSINES, Local, Subject};

/// Checks one lobe. Panics if one of its debug assertions fails.
pub fn check(lobe: &dyn BxDF, options: &Options) -> Report {
    run(&Local(lobe), options)
}

/// Checks a sum of lobes in the frame that it has.
pub fn check_bsdf(bsdf: &Bsdf, options: &Options) -> Report {
    let mut report = run(bsdf, options);
    if bsdf.rejected() > 0 && report.is_ok() {
        report.add(Contract::Invalid, || {
            let count = bsdf.rejected();
            format!("the Bsdf rejected {count} times: results, a frame, or lobes beyond the most that it holds")
        });
    }
    report
}

/// Checks the lobes of a material together, on a flat surface with uv (0.7, 0.4). What textures return elsewhere is not seen.
pub fn check_material(material: &dyn Material, options: &Options) -> Report {
    with_lobes(material, |bsdf| check_bsdf(bsdf, options))
}

/// What [`check_bsdf`] measures from the direction of this cosine, which is not 0. All calls use the same random numbers, so that curves over
/// the angle are smooth.
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
    let options = &Options { samples: options.samples.max(Options::LEAST_SAMPLES), ..*options };
    let mut report = Report::default();
    event_numbers::check(subject, options, &mut report);
    edges::check(subject, &mut report);
    for (index, cos) in COSINES.into_iter().enumerate() {
        directions::check(subject, index, cos, options, &mut report);
    }
    reciprocity::check(subject, options, &mut report);
    report
}
