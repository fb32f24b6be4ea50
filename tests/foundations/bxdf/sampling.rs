//! `sample_f` draws what `pdf` says, and returns what `f` and `pdf` say: every contract that `lobe::check` knows, for each lobe and for
//! what materials make of them. `tests/checker.rs` checks the checker.

use lobe::Spectrum;
use lobe::bxdf::{Bsdf, LambertianReflection, Lobe};
use lobe::check::{Options, Report, check, check_bsdf, check_material};
use lobe::geometry::Frame;
use lobe::glam::Vec3;
use lobe::material::{
    GlassMaterial, Material, MatteMaterial, MetalMaterial, MirrorMaterial, MixMaterial,
    PlasticMaterial, RetroMaterial, Roughness, ThinGlassMaterial, TranslucentMaterial,
};

use super::{ALPHAS, COLOR, all_lobes};
use crate::common::lobes::{BothSides, Through};
use crate::common::parallel;

/// Fails if a contract is broken, or if exchanged directions differ by more than rounding. What comes back from a specular event starts in a
/// direction that is rounded.
fn assert_sound(report: &Report, what: &str) {
    assert!(report.findings.is_empty(), "{what}: {:#?}", report.findings);
    let is_specular = report.directions.iter().any(|d| d.specular != [0.0; 3]);
    let bound = if is_specular { 1e-4 } else { 1e-5 };
    assert!(report.reciprocity < bound, "{what}: reciprocity to {:e}", report.reciprocity);
}

/// As many samples as a run of all tests can afford, and the significance shared between all lobes and materials of this file.
fn options(samples: u32) -> Options {
    Options { samples, checks: 100, ..Options::default() }
}

fn check_lobes(alphas: &[[f32; 2]], samples: u32) {
    let mut lobes = all_lobes(alphas);
    // A lobe of the tests that is not reciprocal.
    lobes.retain(|(name, _)| name != "stretched");
    parallel(lobes.len(), |i| {
        let (name, lobe) = &lobes[i];
        assert_sound(&check(&**lobe, &options(samples)), name);
    });
}

/// Caught: a default `sample_f` that ignores the side of `wo`; a default `pdf` without the side; the value of `ScaledBxDF`'s sample left
/// unscaled.
/// Caught: means of losses of the sides exchanged, or without η²; interpolation in the wrong azimuth; shares of reflected and crossing
/// light exchanged; a density without the share of single scattering; an index that is inverted.
#[test]
fn one_lobe() {
    check_lobes(&ALPHAS[3..5], 1 << 16);
}

/// The same at more roughnesses, with a million samples from each direction.
#[test]
#[ignore = "takes minutes"]
fn one_lobe_with_a_million_samples() {
    check_lobes(&ALPHAS, 1 << 20);
}

fn materials() -> Vec<(&'static str, Box<dyn Material>)> {
    let gold = || MetalMaterial::named("gold").unwrap();
    let blue = || PlasticMaterial::new([0.2, 0.3, 0.8], 1.5);
    let brushed = || Roughness::alpha(0.3).across(0.1);
    vec![
        ("matte", Box::new(MatteMaterial::new(COLOR))),
        ("rough matte", Box::new(MatteMaterial::new(COLOR).with_roughness(0.8))),
        ("mirror", Box::new(MirrorMaterial::new(COLOR))),
        ("glass", Box::new(GlassMaterial::new(1.5))),
        (
            "rough glass",
            Box::new(GlassMaterial::new(1.33).with_kt(COLOR).with_roughness(brushed())),
        ),
        ("thin glass", Box::new(ThinGlassMaterial::new(1.5).with_kt(COLOR))),
        ("metal", Box::new(gold())),
        ("rough metal", Box::new(gold().with_roughness(Roughness::perceptual(0.5)))),
        ("brushed metal", Box::new(gold().with_roughness(brushed()))),
        ("plastic", Box::new(blue())),
        ("rough plastic", Box::new(blue().with_roughness(Roughness::alpha(0.2)))),
        ("brushed plastic", Box::new(blue().with_roughness(brushed()))),
        ("translucent", Box::new(TranslucentMaterial::new(COLOR, 0.3))),
        ("retro", Box::new(RetroMaterial::new(COLOR, 0.7).with_roughness(brushed()))),
        (
            "mix of metal and plastic",
            Box::new(MixMaterial::new(gold().with_roughness(brushed()), blue(), 0.4)),
        ),
        (
            "mix of glass and paper",
            Box::new(MixMaterial::new(
                GlassMaterial::new(1.5).with_roughness(Roughness::alpha(0.4)),
                TranslucentMaterial::new(COLOR, 0.5),
                0.5,
            )),
        ),
        (
            "mix of glass and a mix",
            Box::new(MixMaterial::new(
                GlassMaterial::new(1.5).with_roughness(Roughness::alpha(0.4)),
                MixMaterial::new(MatteMaterial::new(COLOR), MirrorMaterial::new(COLOR), 0.5),
                0.3,
            )),
        ),
    ]
}

/// Caught: u.x used for the choice of a lobe and, not stretched again, for its direction; the pdf of
/// the chosen lobe alone; the sum of densities instead of their mean; `f` of the chosen lobe alone.
/// Caught: caps without their bound in the density; samples not mirrored from below; a scale of a mixture's lobe that is lost.
#[test]
fn mixtures() {
    let materials = materials();
    parallel(materials.len(), |i| {
        let (name, material) = &materials[i];
        assert_sound(&check_material(&**material, &options(1 << 16)), name);
    });
}

/// A lobe with two events among others. Caught: `uc` used for the choice of a lobe and, not stretched again, for that of
/// its event.
#[test]
fn events_within_a_mixture() {
    let n = Vec3::new(0.36, -0.48, -0.8);
    let both = BothSides { reflects: 0.2, transmits: 0.4 };
    let through = Through(0.3);
    let mut bsdf = Bsdf::new(Frame::from_normal(n), n);
    bsdf.add(LambertianReflection::new(Spectrum::splat(0.1)));
    bsdf.add(Lobe::Custom(&both));
    bsdf.add(Lobe::Custom(&through));
    let report = check_bsdf(&bsdf, &options(1 << 19));
    assert!(report.findings.is_empty(), "{:#?}", report.findings);
}
