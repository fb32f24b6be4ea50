//! Contracts of the models, for each pair of directions.

use lobe::Spectrum;
use lobe::bxdf::{BxDF, EnergyPreservingOrenNayar, LambertianReflection, OrenNayar, ScaledBxDF};
use lobe::glam::{Vec2, Vec3};

use super::{lobes, view};
use crate::common::Rng;

/// f(wo, wi) = f(wi, wo) for the crate's own models, half of the directions grazing. Caught: the
/// larger cosine of Oren-Nayar's ratio replaced by that of wo.
#[test]
fn values_are_reciprocal() {
    for trial in 0..200_000 {
        let mut rng = Rng::new(300, trial);
        let mut direction = || {
            let mut w = rng.direction();
            if rng.f32() < 0.5 {
                w.z *= rng.coordinate(4.0).abs().min(1.0);
            }
            w.z = w.z.abs();
            w.normalize()
        };
        let (wo, wi) = (direction(), direction());
        for (name, lobe) in lobes().iter().take(9) {
            let (there, back) = (lobe.f(wo, wi).to_array(), lobe.f(wi, wo).to_array());
            for (a, b) in there.into_iter().zip(back) {
                assert!(
                    (a - b).abs() <= 1e-6 * a,
                    "{name}, trial {trial}: {wo}, {wi}: {a} and {b}"
                );
            }
        }
    }
}

/// Oren-Nayar against its formula in angles and in f64 (PBRT 3rd edition, section 8.4.1). Caught: sin α
/// taken for sin of the smaller angle; sigma in radians; 0.33 and 0.09 swapped.
#[test]
fn oren_nayar_is_the_published_model() {
    for trial in 0..100_000 {
        let mut rng = Rng::new(301, trial);
        let sigma = [0.0, 1e-3, 5.0, 20.0, 45.0, 90.0][rng.below(6)];
        let [theta_o, theta_i] = [0, 1].map(|_| rng.f64() * 1.57);
        let [phi_o, phi_i] = [0, 1].map(|_| rng.f64() * std::f64::consts::TAU);
        let w = |theta: f64, phi: f64| {
            Vec3::new(
                (theta.sin() * phi.cos()) as f32,
                (theta.sin() * phi.sin()) as f32,
                theta.cos() as f32,
            )
        };
        let s2 = f64::from(sigma).to_radians().powi(2);
        let (a, b) = (1.0 - s2 / (2.0 * (s2 + 0.33)), 0.45 * s2 / (s2 + 0.09));
        let (alpha, beta) = (theta_o.max(theta_i), theta_o.min(theta_i));
        let across = (phi_i - phi_o).cos().max(0.0);
        let truth = 0.5 / std::f64::consts::PI * (a + b * across * alpha.sin() * beta.tan());
        let f = OrenNayar::new(Spectrum::splat(0.5), sigma).f(w(theta_o, phi_o), w(theta_i, phi_i));
        let f = f64::from(f.to_array()[0]);
        // tan β amplifies the rounding of the directions themselves.
        let tolerance = 1e-6 * (1.0 + truth * beta.tan());
        assert!(
            (f - truth).abs() <= tolerance,
            "trial {trial}, sigma {sigma}: {f}, expected {truth}"
        );
    }
}

/// Sigma 0 is Lambert's law, bit by bit. Caught: A off by 1e-4.
#[test]
fn smooth_oren_nayar_is_lambertian() {
    let color = Spectrum::new(0.9, 0.5, 0.1);
    let (smooth, lambert) = (OrenNayar::new(color, 0.0), LambertianReflection::new(color));
    for cos in [1.0, 0.3, 1e-4, 1e-7] {
        for wi in [Vec3::Z, view(0.5), view(1e-7)] {
            assert_eq!(smooth.f(view(cos), wi), lambert.f(view(cos), wi));
        }
        assert_eq!(smooth.rho_hd(view(cos), &[], &[]), color);
    }
    assert_eq!(smooth.rho_hh(&[], &[], &[]), color);
}

/// EON's samples lean with wo: the noise of a white surface is the same from all sides. Seen to fail with samples that always lean to the x
/// axis, which are right and noisy.
#[test]
fn samples_of_eon_lean_with_wo() {
    let lobe = EnergyPreservingOrenNayar::new(Spectrum::WHITE, 0.9);
    let [along_x, along_y] = [Vec3::new(0.995, 0.0, 0.1), Vec3::new(0.0, 0.995, 0.1)].map(|wo| {
        let squared = |trial| {
            let mut rng = Rng::new(302, trial);
            let sample = lobe.sample_f(wo.normalize(), 0.5, rng.square()).unwrap();
            f64::from(sample.f.to_array()[0] * sample.wi.z / sample.pdf).powi(2)
        };
        (0..50_000).map(squared).sum::<f64>() / 50_000.0
    });
    assert!((along_x / along_y - 1.0).abs() < 0.02, "{along_x} and {along_y}");
}

/// Every combination of extreme samples, directions and parameters stays finite and not negative.
/// Caught: Oren-Nayar with the smaller cosine in its ratio.
#[test]
fn extremes_stay_finite() {
    let edges = [0.0, 2.0_f32.powi(-24), 0.5, 1.0 - 2.0_f32.powi(-24)];
    let cosines = [0.0, 1e-38, 1e-7, 1e-4, 1.0];
    for (sigma, albedo) in [0.0, 20.0, 90.0].into_iter().flat_map(|s| [(s, 0.0), (s, 1.0)]) {
        let (r, half) = (Spectrum::splat(albedo), Spectrum::splat(0.5));
        let lobes: [(&str, &dyn BxDF); 4] = [
            ("Lambertian", &LambertianReflection::new(r)),
            ("Oren-Nayar", &OrenNayar::new(r, sigma)),
            ("scaled", &ScaledBxDF::new(OrenNayar::new(r, sigma), half)),
            ("scaled by 0", &ScaledBxDF::new(OrenNayar::new(r, sigma), Spectrum::BLACK)),
        ];
        for (name, lobe) in lobes {
            // A wo along the surface never reaches a lobe: see `guard`.
            for wo in cosines[1..].iter().flat_map(|&c| [view(c), -view(c)]) {
                for wi in cosines.iter().flat_map(|&c| [view(c), -view(c)]) {
                    let (f, pdf) = (lobe.f(wo, wi), lobe.pdf(wo, wi));
                    // tan β is 1e38 and leaves the range of f32: that is the guard's to catch.
                    let beyond = wo.z.abs().max(wi.z.abs()) <= 1e-38 && sigma > 0.0;
                    assert!(f.is_valid() || beyond, "{name}, sigma {sigma}: f({wo}, {wi}) = {f:?}");
                    assert!(pdf >= 0.0 && pdf.is_finite(), "{name}: pdf({wo}, {wi}) = {pdf}");
                }
                for u in edges.iter().flat_map(|&x| edges.map(|y| Vec2::new(x, y))) {
                    // A Bsdf passes NaN to lobes that do not use uc.
                    let Some(sample) = lobe.sample_f(wo, f32::NAN, u) else { continue };
                    assert!(sample.f.is_valid() && sample.wi.is_finite(), "{name}: {wo}, {u}");
                    assert!(sample.pdf > 0.0 && sample.pdf.is_finite(), "{name}: {wo}, {u}");
                    assert!((sample.wi.length() - 1.0).abs() < 1e-6, "{name}: {wo}, {u}");
                }
                let rho = lobe.rho_hd(wo, &[0.0, 0.5], &[Vec2::ZERO, Vec2::splat(0.5)]);
                assert!(rho.is_valid() && rho.max_component() < 1.02, "{name}, {wo}: {rho:?}");
            }
        }
    }
}
