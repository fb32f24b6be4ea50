//! Sample values and directions at the edges of their ranges.

use glam::{Vec2, Vec3};

use super::contract::Contract;
use super::report::Report;
use super::subject::{Subject, view};

const VALUES: [f32; 4] = [0.0, 1.0 / (1 << 24) as f32, 0.5, 1.0 - f32::EPSILON / 2.0];
const COSINES: [f32; 8] = [1.0, 0.5, 1e-4, 1e-7, -1e-7, -1e-4, -0.5, -1.0];

/// Everything has to be finite and not negative.
pub fn check(subject: &dyn Subject, report: &mut Report) {
    let mut all: Vec<Vec3> = COSINES.map(view).to_vec();
    all.extend([Vec3::X, -Vec3::X, Vec3::Y, view(-0.0)]);
    for wo in COSINES.map(view) {
        for &wi in &all {
            let (f, pdf) = (subject.f(wo, wi), subject.pdf(wo, wi));
            if !f.is_valid() || !(0.0..f32::INFINITY).contains(&pdf) {
                let [r, g, b] = f.to_array();
                report.add(Contract::Invalid, || {
                    format!("f [{r}, {g}, {b}] and pdf {pdf} of wo {wo} and wi {wi}")
                });
            }
        }
        for (uc, u, v) in VALUES.into_iter().flat_map(|uc| {
            VALUES.into_iter().flat_map(move |u| VALUES.into_iter().map(move |v| (uc, u, v)))
        }) {
            let Some(sample) = subject.sample_f(wo, uc, Vec2::new(u, v)) else { continue };
            let is_unit = (sample.wi.length() - 1.0).abs() < 1e-3;
            let has_density = sample.pdf > 0.0 && sample.pdf < f32::INFINITY;
            if !sample.f.is_valid() || !has_density || !is_unit {
                report.add(Contract::Invalid, || {
                    let [r, g, b] = sample.f.to_array();
                    let (wi, pdf) = (sample.wi, sample.pdf);
                    format!(
                        "the sample of uc {uc}, u [{u}, {v}] from wo {wo}: wi {wi}, f [{r}, {g}, {b}], pdf {pdf}"
                    )
                });
            }
        }
    }
}
