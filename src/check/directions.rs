//! Samples from one direction: their sides, values, densities, distribution and weights.

use glam::Vec3;

use super::cells::{Cells, GROUP};
use super::contract::Contract;
use super::report::{Direction, Estimate, Options, Report};
use super::statistics::{Mean, chi_square, is_close, significance, two_sided};
use super::subject::{COSINES, Subject, values, view};
use crate::bxdf::{BxdfFlags, BxdfSample};
use crate::sampling::Random;

/// Samples by kind, and weights.
struct Tally {
    wo: Vec3,
    directions: Vec<Vec3>,
    rejected: u64,
    specular: u64,
    sampled: [Mean; 3],
    spread: [Mean; 3],
    evaluated: [Mean; 3],
    of_specular: [Mean; 3],
    /// η of refracted samples.
    eta: f32,
    refracted: bool,
    /// By what fraction densities change when directions are rounded otherwise.
    rounding: Mean,
}

/// The largest mean change of the density by rounding for which samples and integrals can be compared.
const RESOLVED: f64 = 2e-3;

/// One sample in this many is compared with f and pdf.
const STRIDE: u32 = 8;

pub fn check(
    subject: &dyn Subject,
    index: usize,
    cos: f32,
    options: &Options,
    report: &mut Report,
) {
    let wo = view(cos);
    let mut random = Random::new(options.seed.wrapping_add(index as u64 + 1));
    let tally = draw(subject, wo, options.samples, &mut random, report);
    let pilot = tally.directions.len() / 4;
    let cells = Cells::new(&tally.directions[..pilot]);
    let mut observed = vec![0_u64; cells.count()];
    for &wi in &tally.directions[pilot..] {
        observed[cells.of(wi)] += 1;
    }
    let eta2 = f64::from(tally.eta * tally.eta);
    let integrand = |wi: Vec3| {
        if wi.z == 0.0 {
            return [0.0; 4];
        }
        let scale = if (wi.z > 0.0) == (wo.z > 0.0) { 1.0 } else { eta2 };
        let [r, g, b] = subject.f(wo, wi).to_array().map(|f| f64::from(f * wi.z.abs()) * scale);
        [subject.pdf(wo, wi).into(), r, g, b]
    };
    let masses: Vec<_> = (0..cells.count()).map(|cell| cells.integrate(cell, &integrand)).collect();
    let total = |i: usize| masses.iter().map(|mass| mass[i]).sum::<f64>();
    let density = total(0);
    let of = f64::from(options.samples);
    let [rejected, specular] = [tally.rejected, tally.specular].map(|count| count as f64 / of);

    // The rest of the pilot's share is as likely to be missing.
    let counted = (tally.directions.len() - pilot) as f64;
    let drawn = tally.directions.len() as f64 / of;
    let groups = observed.chunks(GROUP).zip(masses.chunks(GROUP));
    let expected = groups.map(|(counts, masses)| {
        let mass: f64 = masses.iter().map(|mass| mass[0]).sum();
        (counts.iter().sum(), mass / drawn.max(1e-9) * counted)
    });
    let p = (counted > 1000.0).then(|| chi_square(expected));
    let runs = COSINES.len() as u32 * options.checks;
    let is_resolved = tally.directions.is_empty() || tally.rounding.mean < RESOLVED;
    if let Some(p) = p.filter(|&p| is_resolved && p < significance(runs)) {
        report.add(Contract::Distribution, || format!("from cos {cos}: chi-square p = {p:.1e}"));
    }
    // Counts add their own error to the rejected share.
    let share = 1.0 - rejected - specular;
    let error = (share.max(0.0) * (1.0 - share) / of).sqrt();
    if !density.is_finite() || !(total(1) + total(2) + total(3)).is_finite() {
        report.add(Contract::Invalid, || {
            format!(
                "from cos {cos}: f or pdf where no sample lands, since an integral is no number"
            )
        });
    } else if is_resolved && (density - share).abs() > 1e-3 + 5.0 * error {
        report.add(Contract::Integral, || {
            format!("from cos {cos}: pdf integrates to {density:.5}, and {share:.5} of the sample values give a direction")
        });
    }
    let estimate = |m: Mean| Estimate { mean: m.mean, error: m.standard_error() };
    let direction = Direction {
        cos,
        sampled: tally.sampled.map(estimate),
        spread: tally.spread.map(estimate),
        evaluated: tally.evaluated.map(|m| m.mean),
        integrated: [total(1), total(2), total(3)],
        specular: tally.of_specular.map(|m| m.mean),
        density,
        rejected,
        p,
        is_resolved,
    };
    energy(&direction, options, runs, report);
    report.directions.push(direction);
}

/// Draws samples and compares each with the contract.
fn draw(
    subject: &dyn Subject,
    wo: Vec3,
    count: u32,
    random: &mut Random,
    report: &mut Report,
) -> Tally {
    let mut tally = Tally {
        wo,
        directions: Vec::with_capacity(count as usize),
        rejected: 0,
        specular: 0,
        sampled: [Mean::default(); 3],
        spread: [Mean::default(); 3],
        evaluated: [Mean::default(); 3],
        of_specular: [Mean::default(); 3],
        eta: 1.0,
        refracted: false,
        rounding: Mean::default(),
    };
    for i in 0..count {
        let (uc, u) = values(random);
        let sample = subject.sample_f(wo, uc, u).filter(|sample| {
            // Reported by the grid of edges and here alike.
            let is_valid = sample.f.is_valid() && sample.pdf > 0.0 && sample.wi.is_finite();
            if !is_valid {
                report.add(Contract::Invalid, || {
                    format!("the sample of uc {uc}, u {u} from wo {wo}")
                });
            }
            is_valid
        });
        tally.add(subject, sample.as_ref(), i % STRIDE == 0, report);
    }
    tally
}

impl Tally {
    fn add(
        &mut self,
        subject: &dyn Subject,
        sample: Option<&BxdfSample>,
        compares: bool,
        report: &mut Report,
    ) {
        let Some(sample) = sample else {
            self.rejected += 1;
            self.weigh([0.0; 3], [0.0; 3], false);
            return;
        };
        let (wo, wi) = (self.wo, sample.wi);
        event(subject, wo, sample, report);
        if (wi.z > 0.0) != (wo.z > 0.0) && !sample.is_specular() {
            report.has_several_indices |=
                self.refracted && (sample.eta - self.eta).abs() > 1e-4 * self.eta;
            (self.eta, self.refracted) = (sample.eta, true);
        }
        let scale = wi.z.abs() / sample.pdf * sample.eta * sample.eta;
        let weight = sample.f.to_array().map(|f| f64::from(f * scale));
        if sample.is_specular() {
            self.specular += 1;
            self.weigh(weight, weight, true);
            return;
        }
        let f = subject.f(wo, wi);
        self.weigh(weight, f.to_array().map(|f| f64::from(f * scale)), false);
        self.directions.push(wi);
        if compares {
            let pdf = subject.pdf(wo, wi);
            let moved = subject.pdf(wo, wi + Vec3::new(0.5, -0.5, 0.0) * f32::EPSILON);
            self.rounding.add(f64::from((moved - pdf).abs() / pdf.max(moved)).min(1.0));
            let (f_of_both, pdf_of_both) = subject.f_and_pdf(wo, wi);
            let others =
                [("a sample", sample.f, sample.pdf), ("f_and_pdf()", f_of_both, pdf_of_both)];
            for (from, other_f, other_pdf) in others {
                if !is_close(pdf, other_pdf, 1e-3) {
                    report.add(Contract::Density, || {
                        format!("{other_pdf} of {from}, {pdf} of pdf(), for wo {wo} and wi {wi}")
                    });
                }
                for (other, f) in other_f.to_array().into_iter().zip(f.to_array()) {
                    if !is_close(other, f, 1e-3) {
                        report.add(Contract::Value, || {
                            format!("{other} of {from}, {f} of f(), for wo {wo} and wi {wi}")
                        });
                    }
                }
            }
        }
    }

    fn weigh(&mut self, sampled: [f64; 3], evaluated: [f64; 3], is_specular: bool) {
        for band in 0..3 {
            self.sampled[band].add(sampled[band]);
            self.spread[band].add(if is_specular { 0.0 } else { sampled[band] });
            self.evaluated[band].add(evaluated[band]);
            self.of_specular[band].add(if is_specular { sampled[band] } else { 0.0 });
        }
    }
}

/// The side and the flags of a sample.
fn event(subject: &dyn Subject, wo: Vec3, sample: &BxdfSample, report: &mut Report) {
    let sides = BxdfFlags::REFLECTION | BxdfFlags::TRANSMISSION;
    let wi = sample.wi;
    let reflects = (wo.z > 0.0) == (wi.z > 0.0);
    let side = if reflects { BxdfFlags::REFLECTION } else { BxdfFlags::TRANSMISSION };
    if !subject.flags().contains(side) {
        report.add(Contract::Side, || format!("wi {wi} for wo {wo}"));
    }
    if !subject.sets_flags() {
        return;
    }
    let spread = sample.flags - sides;
    let is_event = sample.flags & sides == side
        && spread.bits().count_ones() == 1
        && subject.flags().contains(spread);
    let has_index = if reflects { sample.eta == 1.0 } else { sample.eta > 0.0 };
    if !is_event || !has_index {
        let (flags, eta) = (sample.flags, sample.eta);
        report.add(Contract::Event, || format!("{flags:?} and eta {eta} for wo {wo} and wi {wi}"));
    }
}

/// What is returned: no more than comes in, as much as is promised, and as much by all ways to measure it.
fn energy(direction: &Direction, options: &Options, runs: u32, report: &mut Report) {
    if report.has_several_indices {
        return;
    }
    // Standard errors that chance exceeds as rarely as the other tests fail.
    let mut limit = 2.0;
    while two_sided(limit) > significance(3 * runs) {
        limit += 0.25;
    }
    let Direction { cos, .. } = *direction;
    for band in 0..3 {
        let Estimate { mean, error } = direction.sampled[band];
        let noise = limit * error + 1e-5;
        if mean > 1.0 + options.white.unwrap_or(1e-3) + noise {
            report.add(Contract::Gain, || {
                format!("from cos {cos}: {mean:.5} of the light is returned")
            });
        }
        if options.white.is_some_and(|tolerance| mean < 1.0 - tolerance - noise) {
            report.add(Contract::Loss, || {
                format!("from cos {cos}: {mean:.5} of the light is returned")
            });
        }
        // Both without specular events, whose number is an error of its own.
        let (Estimate { mean, error }, integral) =
            (direction.spread[band], direction.integrated[band]);
        let noise = limit * error + 1e-5;
        if direction.is_resolved && (mean - integral).abs() > noise + 2e-3 * integral.max(0.5) {
            report.add(Contract::Albedo, || {
                format!(
                    "from cos {cos}: {mean:.5} by samples, {integral:.5} by the integral of f cos θ"
                )
            });
        }
    }
}
