//! f(wo, wi) ηi² / ηo² = f(wi, wo), where η is the index of refraction on the side of each.

use glam::Vec3;

use super::contract::Contract;
use super::report::{Options, Report};
use super::subject::{Subject, values};
use crate::bxdf::BxdfSample;
use crate::sampling::{Random, uniform_sphere};
use crate::spectrum::Spectrum;

/// The largest relative difference that rounding explains, also for narrow lobes, whose half vectors are less exact.
const TOLERANCE: f64 = 1e-3;

/// How many sample values are tried to find the way back of a specular event.
const NUMBERS: u32 = 64;

/// The largest fraction of light that a specular event may carry which these may miss.
const RARE: f32 = 0.05;

pub fn check(subject: &dyn Subject, options: &Options, report: &mut Report) {
    let mut random = Random::new(options.seed ^ 0x5eed);
    for _ in 0..8192 {
        let (uc, u) = values(&mut random);
        let wo = uniform_sphere::sample(u);
        if wo.z == 0.0 {
            continue;
        }
        let (_, other) = values(&mut random);
        let sample = subject.sample_f(wo, uc, other);
        if let Some(sample) = &sample {
            if sample.is_specular() {
                specular(subject, wo, sample, report);
            } else {
                pair(subject, wo, sample.wi, sample.eta, report);
            }
        }
        // Any direction of the same event, but for the index.
        let wi = uniform_sphere::sample(values(&mut random).1);
        let same = |sample: &BxdfSample| (sample.wi.z > 0.0) == (wi.z > 0.0);
        if wi.z != 0.0
            && let Some(sample) = sample.filter(same).filter(|s| !s.is_specular())
        {
            pair(subject, wo, wi, sample.eta, report);
        }
    }
}

fn pair(subject: &dyn Subject, wo: Vec3, wi: Vec3, eta: f32, report: &mut Report) {
    let crosses = (wo.z > 0.0) != (wi.z > 0.0);
    if wi.z == 0.0 || crosses && report.has_several_indices {
        return;
    }
    let difference = difference(subject.f(wo, wi) * (eta * eta), subject.f(wi, wo));
    note(difference, wo, wi, report);
}

/// An event that has only one direction: what it carries has to come back from there.
fn specular(subject: &dyn Subject, wo: Vec3, sample: &BxdfSample, report: &mut Report) {
    let carried = |s: &BxdfSample| s.f * (s.wi.z.abs() * s.eta * s.eta);
    // Near the critical angle, the way back starts from a rounded direction.
    if wo.z.abs().min(sample.wi.z.abs()) < 0.1 {
        return;
    }
    // The event itself, by whichever number selects it.
    let back = (0..NUMBERS).find_map(|i| {
        let uc = (i as f32 * 0.618_034 + 0.01).fract();
        let back = subject.sample_f(sample.wi, uc, glam::Vec2::splat(0.5))?;
        (back.is_specular() && (back.wi - wo).length() < 1e-2).then_some(back)
    });
    match back {
        Some(back) => note(difference(carried(sample), carried(&back)), wo, sample.wi, report),
        // A rare one may not have been found.
        None if carried(sample).max_component() > RARE => {
            report.add(Contract::Reciprocity, || {
                format!("of the light from wi {} to wo {wo}, none goes back", sample.wi)
            });
        }
        None => {}
    }
}

fn note(difference: f64, wo: Vec3, wi: Vec3, report: &mut Report) {
    report.reciprocity = report.reciprocity.max(difference);
    if difference.is_nan() || difference > TOLERANCE {
        report.add(Contract::Reciprocity, || {
            format!("f of wo {wo} and wi {wi} changes by the fraction {difference:.2e} when they are exchanged")
        });
    }
}

/// The largest difference of a band, as a fraction of it.
fn difference(a: Spectrum, b: Spectrum) -> f64 {
    let of_band = |(a, b): (f32, f32)| {
        let (a, b) = (f64::from(a), f64::from(b));
        let larger = a.abs().max(b.abs());
        // Not true of what is no number.
        if larger <= 1e-7 { 0.0 } else { (a - b).abs() / larger }
    };
    let bands = a.to_array().into_iter().zip(b.to_array());
    bands.map(of_band).fold(0.0, |most, x| if x > most || x.is_nan() { x } else { most })
}
