//! The check of lobes is checked: it names what is put wrong in a lobe, and passes right ones.

use lobe::Spectrum;
use lobe::bxdf::{BxDF, BxdfFlags};
use lobe::check::{Options, check, faulty};
use lobe::glam::Vec3;

/// Lobes with one fault each.
/// Caught: f_and_pdf not looked at; specular events without a way back not looked at; findings of energy gained and of the integral left
/// out.
#[test]
fn faults_are_named() {
    let options = Options { samples: 1 << 16, white: Some(1e-3), ..Options::default() };
    let all = faulty();
    assert!(all.len() == 17);
    for faulty in all {
        let report = check(&*faulty.lobe, &options);
        let found: Vec<_> = report.findings.iter().map(|f| f.contract).collect();
        let is_named = faulty.expected.iter().all(|contract| found.contains(contract));
        assert!(is_named, "{}: {:?}", faulty.name, report.findings);
    }
}

/// A lobe with nothing but its flags and f, sampled by the trait's methods.
struct HalfMoon;

impl BxDF for HalfMoon {
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE
    }
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        let side = if wo.truncate().dot(wi.truncate()) > 0.0 { 1.0 } else { 0.0 };
        Spectrum::splat(side / std::f32::consts::PI)
    }
}

/// A value that jumps, which quadrature has to follow.
#[test]
fn a_lobe_of_another_crate_passes() {
    let report = check(&HalfMoon, &Options::default());
    assert!(report.findings.is_empty(), "{:?}", report.findings);
    let half = report
        .directions
        .iter()
        .all(|d| (d.integrated[0] - 0.5).abs() < 1e-3 || d.cos.abs() == 1.0);
    assert!(half, "{:?}", report.directions);
}
