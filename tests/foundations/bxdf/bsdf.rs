//! The sum of lobes: filtering by flags, selection, and the side of light.

use std::f32::consts::FRAC_1_PI;

use lobe::Spectrum;
use lobe::bxdf::{
    Bsdf, BxDF, BxdfFlags, LambertianReflection, Lobe, MAX_LOBES, OrenNayar, ScaledBxDF,
};
use lobe::geometry::Frame;
use lobe::glam::{Vec2, Vec3};

use super::view;
use crate::common::Rng;
use crate::common::lobes::{Delta, Stretched, Through};
use crate::common::stats::assert_mean;

const WHITE: LambertianReflection = LambertianReflection::new(Spectrum::WHITE);
const MIRROR: Delta = Delta { r: 0.8, eta: None };
const WINDOW: Delta = Delta { r: 0.8, eta: Some(1.5) };
const GLOSS: Stretched = Stretched { r: 0.5, m: Vec3::new(0.3, 0.3, 1.0) };

fn flat() -> Bsdf<'static> {
    Bsdf::new(Frame::from_normal(Vec3::Z), Vec3::Z)
}

/// A lobe matches if all of its flags are in the filter. Caught: `intersects` in place of `contains`.
#[test]
fn flags_choose_lobes() {
    let through = Through(0.5);
    let mut bsdf = flat();
    bsdf.add(WHITE);
    bsdf.add(OrenNayar::new(Spectrum::WHITE, 30.0));
    let others: [&dyn BxDF; 4] = [&GLOSS, &through, &MIRROR, &WINDOW];
    for lobe in others {
        bsdf.add(Lobe::Custom(lobe));
    }
    use BxdfFlags as F;
    let table = [
        (F::all(), 6),
        (F::empty(), 0),
        (F::REFLECTION, 0),
        (F::DIFFUSE | F::GLOSSY | F::SPECULAR, 0),
        (F::REFLECTION | F::DIFFUSE, 2),
        (F::REFLECTION | F::DIFFUSE | F::GLOSSY, 3),
        (F::TRANSMISSION | F::DIFFUSE, 1),
        (F::TRANSMISSION | F::SPECULAR, 1),
        (F::all() - F::SPECULAR, 4),
        (F::all() - F::TRANSMISSION, 4),
        (F::TRANSMISSION | F::GLOSSY, 0),
    ];
    let (wo, above, below) = (view(0.7), view(0.4), -view(0.4));
    for (flags, count) in table {
        assert_eq!(bsdf.num_components(flags), count, "{flags:?}");
        let none = count == 0;
        assert_eq!(bsdf.sample_f(wo, 0.3, Vec2::splat(0.3), flags).is_none(), none, "{flags:?}");
        if none {
            assert_eq!(bsdf.pdf(wo, above, flags), 0.0, "{flags:?}");
            assert!(bsdf.f(wo, above, flags).is_black(), "{flags:?}");
            assert!(bsdf.rho_hd(wo, &[0.3], &[Vec2::splat(0.3)], flags).is_black(), "{flags:?}");
        }
    }
    let only =
        |side: F| bsdf.f(wo, if side == F::REFLECTION { above } else { below }, side | F::DIFFUSE);
    let rough = OrenNayar::new(Spectrum::WHITE, 30.0).f(wo, above);
    assert_eq!(only(F::REFLECTION), Spectrum::splat(FRAC_1_PI) + rough);
    assert_eq!(only(F::TRANSMISSION), Spectrum::splat(0.5 * FRAC_1_PI));
}

/// A lobe beyond the eighth is refused and counted. Caught: a refusal that is not counted.
#[test]
fn a_ninth_lobe_is_refused() {
    let mut bsdf = flat();
    for _ in 0..MAX_LOBES {
        assert!(bsdf.add(LambertianReflection::new(Spectrum::splat(0.1))));
    }
    assert_eq!(bsdf.rejected(), 0);
    assert!(!bsdf.add(WHITE));
    assert_eq!(bsdf.rejected(), 1);
    assert_eq!(bsdf.num_components(BxdfFlags::all()), MAX_LOBES);
    let f = bsdf.f(Vec3::Z, Vec3::Z, BxdfFlags::all()).to_array()[0];
    assert!((f - 0.8 * FRAC_1_PI).abs() < 1e-6);
}

/// A delta lobe beside a diffuse one: each is drawn as often as its share says, with its share of its density; the
/// delta adds nothing to `f` and `pdf`. The mirror estimates its albedo at 1, as by default, and the diffuser at R.
/// Caught: the mirror's pdf of 1 not multiplied by its share; the mean density taken for a specular sample too, which
/// is 0; shares that are equal, and in proportion to the estimates alone.
#[test]
fn delta_lobes_are_selected_by_their_share() {
    [1.0, 0.25, 0.0].into_iter().for_each(a_delta_lobe_takes_part);
}

fn a_delta_lobe_takes_part(r: f32) {
    let mirror_share = 0.1 * 0.5 + (1.0 - 0.1) * (1.0 / (1.0 + r));
    let diffuse = Spectrum::splat(r * FRAC_1_PI);
    let mut bsdf = flat();
    bsdf.add(Lobe::Custom(&MIRROR));
    bsdf.add(LambertianReflection::new(Spectrum::splat(r)));
    let wo = view(0.6);
    let all = BxdfFlags::all();
    let mirrored = Vec3::new(-wo.x, -wo.y, wo.z);
    assert_eq!(bsdf.f(wo, mirrored, all), diffuse);
    assert_eq!(bsdf.f(wo, mirrored, BxdfFlags::REFLECTION | BxdfFlags::SPECULAR), Spectrum::BLACK);
    let pdf = bsdf.pdf(wo, mirrored, all);
    assert!((pdf - (1.0 - mirror_share) * 0.6 * FRAC_1_PI).abs() < 1e-6, "{pdf}");

    let (trials, mut specular) = (100_000, 0);
    let mut rng = Rng::new(310, 0);
    for trial in 0..trials {
        let Some(sample) = bsdf.sample_f(wo, rng.f32(), rng.square(), all) else { continue };
        if sample.flags.contains(BxdfFlags::SPECULAR) {
            specular += 1;
            assert!(sample.wi.distance(mirrored) < 1e-6, "trial {trial}");
            assert_eq!((sample.pdf, sample.f), (mirror_share, Spectrum::splat(0.8 / sample.wi.z)));
        } else {
            assert_eq!(sample.pdf, bsdf.pdf(wo, sample.wi, all), "trial {trial}");
            assert_eq!(sample.f, diffuse, "trial {trial}");
        }
    }
    let (share, expected) = (specular as f64 / trials as f64, f64::from(mirror_share));
    let error = (expected * (1.0 - expected) / trials as f64).sqrt();
    assert_mean(share, error, expected, 3, "share of mirror samples");
}

/// A delta lobe without a direction gives no sample. Caught: `?` on the lobe's sample replaced by a
/// default.
#[test]
fn total_internal_reflection_gives_no_sample() {
    let mut bsdf = flat();
    bsdf.add(Lobe::Custom(&WINDOW));
    let inside = |cos: f32| bsdf.sample_f(-view(cos), 0.5, Vec2::splat(0.5), BxdfFlags::all());
    // The critical angle of 1.5 has the cosine 0.745.
    assert!(inside(0.74).is_none());
    let sample = inside(0.75).unwrap();
    assert!(sample.wi.z > 0.0 && sample.pdf == 1.0);
}

/// Reflection and transmission are told apart by the geometric normal, and where the shading normal
/// disagrees, the value is black. `f` is compared with the sum over lobes made here, for tilted shading normals and
/// directions on all sides of both planes.
/// Caught: sides told apart by the shading normal, which lets light leak; by `wi` alone; a value for what
/// no lobe draws, which light sampling alone would find.
#[test]
fn both_normals_have_to_agree() {
    let (reflects, transmits) = (OrenNayar::new(Spectrum::splat(0.6), 25.0), Through(0.3));
    let mut leaks = 0;
    for trial in 0..100_000 {
        let mut rng = Rng::new(311, trial);
        let ng = rng.direction();
        let ns = (ng + 0.9 * rng.direction()).normalize();
        let frame = Frame::from_normal(ns);
        let (wo, wi) = (rng.direction(), rng.direction());
        let (local_wo, local_wi) = (frame.to_local(wo), frame.to_local(wi));
        // Skipped: rounding decides on which side of a plane a nearly parallel direction lies.
        let heights = [wo.dot(ng), wi.dot(ng), local_wo.z, local_wi.z];
        if heights.iter().any(|height| height.abs() < 1e-6) {
            continue;
        }
        let mut both = Bsdf::new(frame, ng);
        both.add(reflects);
        both.add(Lobe::Custom(&transmits));
        let mut opaque = Bsdf::new(frame, ng);
        opaque.add(reflects);

        let reflected = (wo.dot(ng) > 0.0) == (wi.dot(ng) > 0.0);
        let shading_reflected = local_wo.z * local_wi.z > 0.0;
        let expected = match (reflected, shading_reflected) {
            (true, true) => reflects.f(local_wo, local_wi),
            (false, false) => transmits.f(local_wo, local_wi),
            _ => Spectrum::BLACK,
        };
        let all = BxdfFlags::all();
        assert_eq!(both.f(wo, wi, all), expected, "trial {trial}");
        let seen = opaque.f(wo, wi, all);
        assert_eq!(seen, if reflected { expected } else { Spectrum::BLACK }, "trial {trial}");
        leaks += u32::from(reflected != shading_reflected);

        // Samples follow the same rule.
        if let Some(sample) = opaque.sample_f(wo, rng.f32(), rng.square(), all) {
            let side = sample.wi.dot(ng);
            let through = (wo.dot(ng) > 0.0) != (side > 0.0) && side.abs() > 1e-6;
            assert!(!through || sample.f.is_black(), "trial {trial}: light leaks to {}", sample.wi);
        }
    }
    assert!(leaks > 10_000, "only {leaks} trials had directions between the two planes");
}

/// A term with a scale is a scaled lobe, whichever is drawn, alone and beside others.
#[test]
fn terms_are_scaled_lobes() {
    let (scale, all) = (Spectrum::new(0.25, 0.5, 0.0), BxdfFlags::all());
    let dimmed = [ScaledBxDF::new(GLOSS, scale), ScaledBxDF::new(GLOSS, scale * 0.5)];
    for (count, beside) in [(1, false), (1, true), (2, false)] {
        let (mut terms, mut lobes) = (flat(), flat());
        if beside {
            terms.add(WHITE);
            lobes.add(WHITE);
        }
        for (i, dimmed) in dimmed.iter().take(count).enumerate() {
            terms.add_scaled(Lobe::Custom(&GLOSS), if i == 0 { scale } else { scale * 0.5 });
            lobes.add(dimmed as &dyn BxDF);
        }
        for trial in 0..1000 {
            let mut rng = Rng::new(320, trial);
            let (wo, uc, u) = (view(0.7), rng.f32(), Vec2::new(rng.f32(), rng.f32()));
            let [sample, expected] = [&terms, &lobes].map(|bsdf| bsdf.sample_f(wo, uc, u, all));
            assert_eq!(sample, expected, "trial {trial}");
            let wi = rng.direction();
            let value = terms.f_and_pdf(wo, wi, all);
            assert_eq!(value, lobes.f_and_pdf(wo, wi, all), "trial {trial}");
            assert_eq!(value, (terms.f(wo, wi, all), terms.pdf(wo, wi, all)), "trial {trial}");
            let [rho, expected] = [&terms, &lobes].map(|bsdf| bsdf.rho_hd(wo, &[uc], &[u], all));
            assert_eq!(rho, expected, "trial {trial}");
            let [rho, expected] = [&terms, &lobes].map(|bsdf| bsdf.rho_hh(&[u], &[uc], &[u], all));
            assert_eq!(rho, expected, "trial {trial}");
        }
    }
}
