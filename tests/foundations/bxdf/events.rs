//! Events: flags and index, selection among lobes, and errors of custom lobes.

use lobe::Spectrum;
use lobe::bxdf::{
    Bsdf, BxDF, BxdfFlags, BxdfSample, LambertianReflection, Lobe, OrenNayar, ScaledBxDF,
};
use lobe::geometry::{Frame, reflect, refract};
use lobe::glam::{Vec2, Vec3};

use super::view;
use crate::common::Rng;
use crate::common::stats::assert_mean;

const SIDES: BxdfFlags = BxdfFlags::REFLECTION.union(BxdfFlags::TRANSMISSION);

/// Flags and index that a lobe may report in its samples, right and wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Writes {
    Events,
    AlwaysReflected,
    AlwaysTransmitted,
    Diffuse,
    NoIndex,
}

/// A smooth boundary of index 1.5 that reflects a fixed share.
#[derive(Clone, Copy)]
struct Glass(Writes);

const REFLECTED: f32 = 0.3;

impl BxDF for Glass {
    fn flags(&self) -> BxdfFlags {
        SIDES | BxdfFlags::SPECULAR
    }
    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        Spectrum::BLACK
    }
    fn pdf(&self, _wo: Vec3, _wi: Vec3) -> f32 {
        0.0
    }
    fn sample_f(&self, wo: Vec3, uc: f32, _u: Vec2) -> Option<BxdfSample> {
        let n = Vec3::Z * wo.z.signum();
        let eta = if wo.z > 0.0 { 1.5 } else { 1.0 / 1.5 };
        let transmitted = refract(wo, n, 1.0 / eta).filter(|_| uc >= REFLECTED);
        let (wi, share) = match transmitted {
            Some(wi) => (wi, 1.0 - REFLECTED),
            None => (reflect(wo, n), REFLECTED),
        };
        let f = Spectrum::splat(share / wi.z.abs());
        Some(match (self.0, transmitted.is_some()) {
            (Writes::AlwaysReflected, _) | (Writes::Events, false) => {
                BxdfSample::specular(f, wi, share)
            }
            (Writes::Diffuse, true) => BxdfSample::diffuse(f, wi, share).transmitted(eta),
            (Writes::Diffuse, false) => BxdfSample::diffuse(f, wi, share),
            (Writes::NoIndex, _) => BxdfSample::specular(f, wi, share).transmitted(f32::NAN),
            _ => BxdfSample::specular(f, wi, share).transmitted(eta),
        })
    }
}

fn flat() -> Bsdf<'static> {
    Bsdf::new(Frame::from_normal(Vec3::Z), Vec3::Z)
}

/// Whatever a lobe reports, an event's side follows from its directions, a reflection has no index, and a delta
/// lobe has no diffuse events. Only the index of a refraction is needed from the lobe, and counted if it is missing.
/// Caught: the lobe's own flags passed on; the index kept for reflections; a missing index not counted.
#[test]
fn events_are_what_their_directions_say() {
    for writes in [
        Writes::Events,
        Writes::AlwaysReflected,
        Writes::AlwaysTransmitted,
        Writes::Diffuse,
        Writes::NoIndex,
    ] {
        let glass = Glass(writes);
        for trial in 0..2000 {
            let mut rng = Rng::new(330, trial);
            let mut bsdf = flat();
            bsdf.add(Lobe::Custom(&glass));
            let wo = view(0.05 + 0.95 * rng.f32()) * if trial % 2 == 0 { 1.0 } else { -1.0 };
            let uc = rng.f32();
            let sample = bsdf.sample_f(wo, uc, rng.square(), BxdfFlags::all()).unwrap();
            let what = format!("{writes:?}, trial {trial}: {sample:?}");
            let reflects = (sample.wi.z > 0.0) == (wo.z > 0.0);
            let side = if reflects { BxdfFlags::REFLECTION } else { BxdfFlags::TRANSMISSION };
            assert_eq!(sample.flags, side | BxdfFlags::SPECULAR, "{what}");
            let told = !matches!(writes, Writes::AlwaysReflected | Writes::NoIndex);
            let eta = match reflects || !told {
                true => 1.0,
                false if wo.z > 0.0 => 1.5,
                false => 1.0 / 1.5,
            };
            assert_eq!(sample.eta, eta, "{what}");
            assert_eq!(bsdf.rejected(), u32::from(!reflects && !told), "{what}");
        }
    }
}

/// A mirror whose author forgot `sample_f`: the cosine hemisphere never finds its direction. Caught: black without a
/// count.
#[test]
fn a_delta_lobe_without_sampling_is_counted() {
    struct Forgotten;
    impl BxDF for Forgotten {
        fn flags(&self) -> BxdfFlags {
            BxdfFlags::REFLECTION | BxdfFlags::SPECULAR
        }
        fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
            Spectrum::BLACK
        }
    }
    let mut bsdf = flat();
    bsdf.add(Lobe::Custom(&Forgotten));
    let sample = bsdf.sample_f(view(0.5), 0.5, Vec2::splat(0.3), BxdfFlags::all());
    assert!(sample.is_none_or(|sample| sample.f.is_black()));
    assert_eq!(bsdf.rejected(), 1);
}

/// A mirror of reflectance 1 that returns this albedo estimate.
#[derive(Clone, Copy)]
struct Mirror(f32);

impl BxDF for Mirror {
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::SPECULAR
    }
    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        Spectrum::BLACK
    }
    fn pdf(&self, _wo: Vec3, _wi: Vec3) -> f32 {
        0.0
    }
    fn sample_f(&self, wo: Vec3, _uc: f32, _u: Vec2) -> Option<BxdfSample> {
        let f = Spectrum::splat(1.0 / wo.z.abs());
        Some(BxdfSample::specular(f, Vec3::new(-wo.x, -wo.y, wo.z), 1.0))
    }
    fn uses_uc(&self) -> bool {
        false
    }
    fn albedo_estimate(&self, _wo: Vec3) -> f32 {
        self.0
    }
}

/// Nine tenths of the selection probability follow the albedo estimates, and one tenth is uniform. So
/// whatever the estimates are, right, wrong or NaN, no light is lost: the mean of f |cos θ| / pdf is the
/// sum of the albedos, and pdf and f are those of all lobes.
/// Caught: shares in proportion alone, which lose the mirror that tells 0; estimates that are not brought into
/// [0, 1]; a share that the mean density does not use.
#[test]
fn lobes_are_drawn_by_albedo_and_none_is_lost() {
    let diffuse = LambertianReflection::new(Spectrum::splat(0.25));
    let cases = [
        (0.25, 0.5),
        (0.75, 0.9 * 0.75 + 0.05),
        (0.0, 0.05),
        (-3.0, 0.05),
        (f32::NAN, 0.05),
        (1.0, 0.9 * 0.8 + 0.05),
        (f32::INFINITY, 0.9 * 0.8 + 0.05),
    ];
    let all = BxdfFlags::all();
    for (case, (told, share)) in cases.into_iter().enumerate() {
        let mirror = Mirror(told);
        let mut bsdf = flat();
        bsdf.add(Lobe::Custom(&mirror));
        bsdf.add(diffuse);
        let (wo, trials) = (view(0.6), 100_000);
        let mut rng = Rng::new(331, case as u64);
        let (mut mirrored, mut light) = (0, Vec::with_capacity(trials));
        for trial in 0..trials {
            let sample = bsdf.sample_f(wo, rng.f32(), rng.square(), all).unwrap();
            if sample.is_specular() {
                mirrored += 1;
                assert!((sample.pdf - share).abs() < 1e-6, "told {told}: {}", sample.pdf);
            } else {
                let pdf = (1.0 - share) * sample.wi.z * std::f32::consts::FRAC_1_PI;
                assert!((sample.pdf / pdf - 1.0).abs() < 1e-5, "told {told}, trial {trial}");
                assert_eq!(sample.pdf, bsdf.pdf(wo, sample.wi, all), "told {told}, trial {trial}");
                assert_eq!(
                    (sample.f, sample.pdf),
                    bsdf.f_and_pdf(wo, sample.wi, all),
                    "told {told}, trial {trial}"
                );
            }
            light.push(f64::from(sample.f.to_array()[0] * sample.wi.z / sample.pdf));
        }
        let n = trials as f64;
        let error = (f64::from(share * (1.0 - share)) / n).sqrt();
        let what = format!("share of a mirror that tells {told}");
        assert_mean(f64::from(mirrored) / n, error, share.into(), 2 * cases.len(), &what);
        let (mean, error) = crate::common::stats::mean(light.into_iter());
        assert_mean(mean, error, 1.25, 2 * cases.len(), &format!("light, told {told}"));
        assert_eq!(bsdf.rejected(), 0);
    }
}

/// Lobes whose estimates are all 0 are drawn alike, and their probabilities sum to 1.
/// Caught: no shares but the uniform tenth.
#[test]
fn lobes_that_promise_nothing_are_drawn_alike() {
    let mirror = Mirror(0.0);
    let mut bsdf = flat();
    (0..4).for_each(|_| assert!(bsdf.add(Lobe::Custom(&mirror))));
    for trial in 0..40 {
        let uc = (trial as f32 + 0.5) / 40.0;
        let sample = bsdf.sample_f(view(0.5), uc, Vec2::ZERO, BxdfFlags::all()).unwrap();
        assert!((sample.pdf - 0.25).abs() < 1e-6, "{uc}: {}", sample.pdf);
    }
}

/// A delta event of a lobe that calls itself diffuse stays one: its pdf is a probability, and no density that other
/// directions could be compared with.
/// Caught: the event made diffuse after the lobe's flags.
#[test]
fn delta_events_stay_delta_events() {
    struct Mislabelled;
    impl BxDF for Mislabelled {
        fn flags(&self) -> BxdfFlags {
            BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE
        }
        fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
            Spectrum::BLACK
        }
        fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample> {
            Mirror(1.0).sample_f(wo, uc, u)
        }
    }
    let mut bsdf = flat();
    bsdf.add(Lobe::Custom(&Mislabelled));
    let sample = bsdf.sample_f(view(0.5), 0.5, Vec2::ZERO, BxdfFlags::all()).unwrap();
    assert_eq!(sample.flags, BxdfFlags::REFLECTION | BxdfFlags::SPECULAR);
    assert_eq!((sample.f, sample.pdf), (Spectrum::splat(1.0 / 0.5), 1.0));
}

/// `f_and_pdf` is `f` and `pdf`, for a lobe whose value depends on which direction is which: light that crosses a
/// boundary is such a case.
/// Caught: the two directions exchanged in `f_and_pdf`; a density there for directions beneath the surface.
#[test]
fn f_and_pdf_are_f_and_pdf() {
    struct OneWay;
    impl BxDF for OneWay {
        fn flags(&self) -> BxdfFlags {
            BxdfFlags::REFLECTION | BxdfFlags::DIFFUSE
        }
        fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
            Spectrum::new(wo.z, wi.z, 0.5)
        }
    }
    let (wo, wi, all) = (view(0.25), view(0.75), BxdfFlags::all());
    let mut bsdf = flat();
    bsdf.add(Lobe::Custom(&OneWay));
    assert_eq!(bsdf.f(wo, wi, all), Spectrum::new(0.25, 0.75, 0.5));
    assert_eq!(bsdf.f_and_pdf(wo, wi, all), (bsdf.f(wo, wi, all), bsdf.pdf(wo, wi, all)));
    assert!(bsdf.pdf(wo, wi, all) > bsdf.pdf(wi, wo, all));
    // A second lobe takes the other way to the density.
    for _ in 0..2 {
        for (wo, wi) in [(wo, -wi), (-wo, wi)] {
            assert_eq!(bsdf.f_and_pdf(wo, wi, all), (Spectrum::BLACK, 0.0));
            assert_eq!((bsdf.f(wo, wi, all), bsdf.pdf(wo, wi, all)), (Spectrum::BLACK, 0.0));
        }
        bsdf.add(LambertianReflection::new(Spectrum::WHITE));
    }
}

/// Samples that a lobe leaves to the trait are glossy if the lobe is, without a `Bsdf` that would correct them.
/// Caught: always diffuse.
#[test]
fn default_samples_have_the_lobes_spread() {
    struct Gloss(BxdfFlags);
    impl BxDF for Gloss {
        fn flags(&self) -> BxdfFlags {
            BxdfFlags::REFLECTION | self.0
        }
        fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
            Spectrum::WHITE
        }
    }
    for spread in [BxdfFlags::DIFFUSE, BxdfFlags::GLOSSY] {
        let sample = Gloss(spread).sample_f(view(0.5), 0.5, Vec2::splat(0.5)).unwrap();
        assert_eq!(sample.flags, BxdfFlags::REFLECTION | spread);
    }
}

/// The remainder of `uc` is uniform again within the selected lobe, as three lobes show.
/// Caught: `uc` handed on as it came; the rest divided by the wrong share.
#[test]
fn the_rest_of_uc_is_uniform() {
    struct Shows(f32);
    impl BxDF for Shows {
        fn flags(&self) -> BxdfFlags {
            BxdfFlags::REFLECTION | BxdfFlags::SPECULAR
        }
        fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
            Spectrum::BLACK
        }
        fn sample_f(&self, _wo: Vec3, uc: f32, _u: Vec2) -> Option<BxdfSample> {
            Some(BxdfSample::specular(Spectrum::new(self.0, uc, 0.0), Vec3::Z, 1.0))
        }
        fn albedo_estimate(&self, _wo: Vec3) -> f32 {
            self.0
        }
    }
    let lobes = [0.1, 0.6, 0.3].map(Shows);
    let mut bsdf = flat();
    lobes.iter().for_each(|lobe| assert!(bsdf.add(lobe as &dyn BxDF)));
    let steps = 30_000;
    let mut rests = [const { Vec::new() }; 3];
    for step in 0..steps {
        let uc = (step as f32 + 0.5) / steps as f32;
        let sample = bsdf.sample_f(view(0.5), uc, Vec2::ZERO, BxdfFlags::all()).unwrap();
        let [told, rest, _] = sample.f.to_array();
        let lobe = lobes.iter().position(|lobe| lobe.0 == told).unwrap();
        rests[lobe].push(rest);
    }
    for (lobe, rests) in rests.iter().enumerate() {
        let share = 0.9 * lobes[lobe].0 + 0.1 / 3.0;
        assert!((rests.len() as f32 / steps as f32 - share).abs() < 1e-4, "lobe {lobe}");
        // Even steps of uc give even steps of its rest, from 0 to 1.
        for (i, &rest) in rests.iter().enumerate() {
            let even = (i as f32 + 0.5) / rests.len() as f32;
            assert!((rest - even).abs() < 1e-3, "lobe {lobe}: {rest} in place of {even}");
        }
    }
}

/// `uses_uc` is true only if a lobe or the selection uses it.
/// Caught: always true, and always false.
#[test]
fn uses_uc_is_true_only_if_something_uses_it() {
    let white = LambertianReflection::new(Spectrum::WHITE);
    let (mirror, glass) = (Mirror(1.0), Glass(Writes::Events));
    let of = |lobes: &[Lobe<'static>]| {
        let mut bsdf = flat();
        lobes.iter().for_each(|&lobe| assert!(bsdf.add(lobe)));
        bsdf.uses_uc()
    };
    let [mirror, glass]: [&'static dyn BxDF; 2] =
        [Box::leak(Box::new(mirror)), Box::leak(Box::new(glass))];
    assert!(!of(&[]) && !of(&[white.into()]) && !of(&[mirror.into()]));
    assert!(of(&[glass.into()]) && of(&[white.into(), white.into()]));
    assert!(of(&[mirror.into(), white.into()]));
}

/// A frame that is not orthonormal would change how much light there is, since cosines come from it. It is
/// refused, and counted.
/// Caught: no look at the frame.
#[test]
fn crooked_frames_are_refused() {
    let n = Vec3::new(0.6, 0.0, 0.8);
    let straight = Frame::from_normal(n);
    assert_eq!(Bsdf::new(straight, n).rejected(), 0);
    let long = Frame { n: n * 1.1, ..straight };
    let skew = Frame { s: (straight.s + 0.1 * straight.t).normalize(), ..straight };
    let no_number = Frame { t: Vec3::NAN, ..straight };
    for crooked in
        [long, skew, no_number, Frame::from_normal(n * 0.9), Frame::from_normal(Vec3::ZERO)]
    {
        let bsdf = Bsdf::new(crooked, n);
        assert_eq!(bsdf.rejected(), 1, "{crooked:?}");
        assert!(bsdf.frame().is_orthonormal() && bsdf.frame().n == n, "{crooked:?}");
        assert!((bsdf.abs_cos_theta(n) - 1.0).abs() < 1e-6, "{crooked:?}");
    }
}

/// The cosine is that of the Bsdf's own frame, whichever way its normal leans: f |cos θ| / pdf of a mirror is
/// its reflectance.
/// Caught: the cosine of the geometric normal.
#[test]
fn cosines_come_from_the_frame() {
    let mirror = Mirror(1.0);
    for trial in 0..10_000 {
        let mut rng = Rng::new(332, trial);
        let ng = rng.direction();
        let ns = (ng + 0.9 * rng.direction()).normalize();
        let mut bsdf = Bsdf::new(Frame::from_normal(ns), ng);
        bsdf.add(Lobe::Custom(&mirror));
        let wo = rng.direction();
        if wo.dot(ns).abs() < 1e-3 {
            continue;
        }
        let sample = bsdf.sample_f(wo, 0.5, rng.square(), BxdfFlags::all()).unwrap();
        let light = sample.f * (bsdf.abs_cos_theta(sample.wi) / sample.pdf);
        assert!((light.to_array()[0] - 1.0).abs() < 1e-3, "trial {trial}: {light:?}");
    }
}

/// A diffuser's estimate is its reflectance, rough or not.
/// Caught: the largest band exchanged for the rest; a factor of the roughness.
#[test]
fn diffusers_estimate_their_reflectance() {
    let r = Spectrum::new(0.25, 0.75, 0.5);
    assert_eq!(LambertianReflection::new(r).albedo_estimate(view(0.5)), 0.75);
    assert_eq!(OrenNayar::new(r, 60.0).albedo_estimate(view(0.5)), 0.75);
}

/// A dimmed lobe is drawn less often, and looks at `uc` if the lobe does.
/// Caught: the scale left out of the estimate; `uses_uc` always false.
#[test]
fn scaled_lobes_scale_their_estimate() {
    let grey = LambertianReflection::new(Spectrum::splat(0.5));
    let dimmed = ScaledBxDF::new(grey, Spectrum::new(0.25, 0.5, 0.125));
    assert_eq!(dimmed.albedo_estimate(view(0.5)), 0.25);
    assert!(!dimmed.uses_uc());
    assert!(ScaledBxDF::new(Glass(Writes::Events), Spectrum::WHITE).uses_uc());
}
