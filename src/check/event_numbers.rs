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
            let other = (uc + 0.5).fract();
            // Values that are no numbers are another fault, and equal none.
            let of = |uc| {
                let sample = subject.sample_f(wo, uc, u).filter(|sample| sample.f.is_valid());
                sample.map(|sample| (sample.wi, sample.f, sample.pdf))
            };
            if of(uc) != of(other) {
                report.add(Contract::EventNumber, || format!("uc {uc} and {other} from wo {wo}"));
            }
        }
    }
}
