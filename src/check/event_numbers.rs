//! Whether samples depend on `uc`, where a lobe says that they do not.

use super::contract::Contract;
use super::report::{Options, Report};
use super::subject::{COSINES, Subject, values, view};
use crate::sampling::Random;

/// Draws the same directions with different event numbers.
pub fn check(subject: &dyn Subject, options: &Options, report: &mut Report) {
    if subject.uses_uc() {
        return;
    }
    let mut random = Random::new(options.seed ^ 0xe0e0);
    for wo in COSINES.map(view) {
        for _ in 0..64 {
            let (uc, u) = values(&mut random);
            let of =
                |uc| subject.sample_f(wo, uc, u).map(|sample| (sample.wi, sample.f, sample.pdf));
            if of(uc) != of(1.0 - uc) {
                report.add(Contract::EventNumber, || {
                    format!("uc {uc} and {} from wo {wo}", 1.0 - uc)
                });
            }
        }
    }
}
