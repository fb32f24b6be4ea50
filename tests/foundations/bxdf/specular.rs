//! Mirrors and smooth boundaries: directions, shares and events.

use lobe::Spectrum;
use lobe::bxdf::fresnel::{Fresnel, conductor, dielectric};
use lobe::bxdf::{
    BxDF, BxdfFlags, BxdfSample, FresnelSpecular, Lobe, SpecularReflection, SpecularTransmission,
};
use lobe::glam::{DVec3, Vec2, Vec3};

use super::fresnel::ETAS;
use crate::common::Rng;

const R: Spectrum = Spectrum::new(0.9, 0.5, 0.0);
const T: Spectrum = Spectrum::new(0.3, 0.7, 1.0);

/// What an event carries, f |cos θi| / pdf, in the green band.
fn throughput(sample: &BxdfSample) -> f64 {
    f64::from(sample.f.to_array()[1]) * f64::from(sample.wi.z.abs()) / f64::from(sample.pdf)
}

/// A direction on either side: any, close to the surface, or close to the normal.
fn direction(rng: &mut Rng) -> Vec3 {
    let cos = match rng.below(3) {
        0 => rng.f32().max(1e-6),
        1 => rng.f32().max(1e-3) * 1e-3,
        _ => 1.0 - rng.f32() * 1e-4,
    };
    let around = Vec2::from_angle(6.3 * rng.f32()) * ((1.0 - cos) * (1.0 + cos)).sqrt();
    around.extend(cos * rng.sign())
}

fn close(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() <= 1e-5 * expected.abs(), "{what}: {found}, not {expected}");
}

/// The refracted direction by Snell's law in f64; `None` beyond the critical angle.
fn snell(wo: Vec3, eta: f64) -> Option<DVec3> {
    let wo = wo.as_dvec3();
    let across = -wo.truncate() / eta;
    let cos2 = ((eta - 1.0) * (eta + 1.0) + wo.z * wo.z) / (eta * eta);
    (cos2 > 0.0).then(|| across.extend(-cos2.sqrt().copysign(wo.z)))
}

/// Seen to fail with the cosine of the mirror direction negated, with no division by it, and with a reflectance from one side.
#[test]
fn mirrors_reflect_what_fresnel_says() {
    let [eta, k] = [Spectrum::new(0.2, 0.4, 1.3), Spectrum::new(3.9, 2.4, 1.8)];
    for trial in 0..30_000 {
        let mut rng = Rng::new(530, trial);
        let wo = direction(&mut rng);
        let (fresnel, expected) = match trial % 3 {
            0 => (Fresnel::NoOp, 1.0),
            1 => (
                Fresnel::Conductor { eta: eta.to_array(), k: k.to_array() },
                conductor(wo.z, eta, k).to_array()[1],
            ),
            _ => {
                let relative = if wo.z < 0.0 { 1.0 / 1.5 } else { 1.5 };
                (Fresnel::Dielectric { eta: 1.5 }, dielectric(wo.z, relative))
            }
        };
        let lobe = Lobe::from(SpecularReflection::new(R, fresnel));
        let sample = lobe.sample_f(wo, f32::NAN, Vec2::NAN).unwrap();
        let what = format!("trial {trial}, {wo}, {fresnel:?}");
        assert_eq!(sample.wi, Vec3::new(-wo.x, -wo.y, wo.z), "{what}");
        assert_eq!(sample.flags, BxdfFlags::REFLECTION | BxdfFlags::SPECULAR, "{what}");
        assert_eq!((sample.pdf, sample.eta), (1.0, 1.0), "{what}");
        close(throughput(&sample), 0.5 * f64::from(expected), &what);
        close(lobe.rho_hd(wo, &[], &[]).to_array()[1].into(), throughput(&sample), &what);
        let most = lobe.rho_hd(wo, &[], &[]).max_component();
        assert_eq!(lobe.albedo_estimate(wo), most, "{what}");
    }
}

/// Seen to fail with the index of the other side, with 1/η in place of 1/η², with total reflection ignored, with the side of wo
/// forgotten, and with t for r.
#[test]
fn boundaries_reflect_and_refract() {
    let (mut totals, mut refractions) = (0, 0);
    for trial in 0..200_000 {
        let mut rng = Rng::new(531, trial);
        let (wo, eta) = (direction(&mut rng), ETAS[rng.below(ETAS.len())]);
        let relative = if wo.z < 0.0 { 1.0 / eta } else { eta };
        let reflected = f64::from(dielectric(wo.z, relative));
        let both = Lobe::from(FresnelSpecular::new(R, T, eta));
        let uc = [0.0, rng.f32(), 1.0 - f32::EPSILON / 2.0][rng.below(3)];
        let sample = both.sample_f(wo, uc, Vec2::NAN).unwrap();
        let what = format!("trial {trial}, {wo}, eta {eta}, uc {uc}");
        let alone = Lobe::from(SpecularTransmission::new(T, eta));
        let refracted = alone.sample_f(wo, f32::NAN, Vec2::NAN);
        assert_eq!(refracted.is_none(), reflected == 1.0, "{what}");
        totals += u32::from(refracted.is_none());
        if f64::from(uc) < reflected {
            assert_eq!(sample.wi, Vec3::new(-wo.x, -wo.y, wo.z), "{what}");
            assert_eq!(sample.flags, BxdfFlags::REFLECTION | BxdfFlags::SPECULAR, "{what}");
            close(sample.pdf.into(), reflected, &what);
            close(throughput(&sample), 0.5, &what);
        } else {
            refractions += 1;
            let wi = snell(wo, relative.into()).expect(&what);
            // The cosine's square is a difference over η².
            let error = 1.0 + f64::from(relative).powi(-2);
            let off = (sample.wi.as_dvec3() - wi).length();
            assert!(off < 1e-6 + 1e-7 * error / wi.z.abs(), "{what}: {}, not {wi}", sample.wi);
            let length = f64::from(sample.wi.length());
            assert!((length - 1.0).abs() < 1e-6 + 1e-7 * error, "{what}: {}", sample.wi);
            assert_eq!(sample.flags, BxdfFlags::TRANSMISSION | BxdfFlags::SPECULAR, "{what}");
            assert_eq!(sample.eta, relative, "{what}");
            close(sample.pdf.into(), 1.0 - reflected, &what);
            let eta2 = f64::from(relative) * f64::from(relative);
            close(throughput(&sample) * eta2, 0.7, &what);
            let refracted = refracted.expect(&what);
            assert_eq!((refracted.wi, refracted.eta), (sample.wi, sample.eta), "{what}");
            close(throughput(&refracted) * eta2, 0.7 * (1.0 - reflected), &what);
        }
        let total = R * reflected as f32 + T * (1.0 - reflected as f32);
        close(both.albedo_estimate(wo).into(), total.max_component().into(), &what);
        let through = f64::from(alone.albedo_estimate(wo));
        close(through, 1.0 - reflected, &what);
    }
    assert!(totals > 10_000 && refractions > 50_000, "{totals}, {refractions}");
}

/// Delta lobes are black for given directions, and say so.
#[test]
fn given_directions_are_black() {
    let lobes: [Lobe; 3] = [
        SpecularReflection::new(R, Fresnel::NoOp).into(),
        SpecularTransmission::new(T, 1.5).into(),
        FresnelSpecular::new(R, T, 1.5).into(),
    ];
    for lobe in lobes {
        let wo = Vec3::new(0.6, 0.0, 0.8);
        let sample = lobe.sample_f(wo, 0.5, Vec2::NAN).unwrap();
        assert_eq!((lobe.f(wo, sample.wi), lobe.pdf(wo, sample.wi)), (Spectrum::BLACK, 0.0));
        assert!(lobe.flags().contains(BxdfFlags::SPECULAR) && lobe.flags().contains(sample.flags));
    }
    assert!(!lobes[0].uses_uc() && !lobes[1].uses_uc() && lobes[2].uses_uc());
}
