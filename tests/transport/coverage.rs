//! How often the truth lies in the 95 % confidence interval that the film's variance gives.

use lobe::glam::{UVec2, Vec3};
use lobe::image::Image;
use lobe::integrator::PathIntegrator;
use lobe::light::SkyLight;
use lobe::metrics::{half_widths, z_test};
use lobe::render::SamplerSettings;
use lobe::sampling::SamplerKind;
use lobe::scene::{Emission, Scene, View};
use lobe::scene_file::read_scene;
use lobe::{RenderOptions, RenderSettings, Spectrum, TriangleMesh, render};

use crate::scenes::{ball_over_floor, chapter_view};

const CORRELATED: [(&str, SamplerKind); 3] = [
    ("stratified", SamplerKind::STRATIFIED),
    ("sobol", SamplerKind::SOBOL),
    ("blue noise", SamplerKind::BLUE_NOISE),
];

/// What the intervals of pictures with other seeds are, over all bands whose values vary.
#[derive(Debug)]
struct Coverage {
    /// Share of bands with the truth in their interval.
    covered: f64,
    /// Mean half width over the mean of 1.96 true standard errors.
    width: f64,
    /// Share of bands that claim no error.
    without_error: f64,
}

/// The pictures of seeds 0, 1 and so on.
fn pictures(
    (scene, view): (&Scene, &View),
    settings: &RenderSettings,
    sampler: SamplerSettings,
    seeds: u64,
) -> Vec<Image> {
    let of = |seed| {
        let sampler = SamplerSettings { seed, ..sampler };
        let settings = RenderSettings { sampler, integrator: settings.integrator.clone() };
        let options = RenderOptions { layers: true, ..RenderOptions::default() };
        Image::from(&render(scene, view, &settings, &options).unwrap().picture)
    };
    (0..seeds).map(of).collect()
}

fn bands(pixels: &[Spectrum]) -> Vec<f64> {
    pixels.iter().flat_map(|pixel| pixel.to_array()).map(f64::from).collect()
}

fn coverage(pictures: &[Image], truth: &Image) -> Coverage {
    let truth = bands(&truth.pixels);
    let values: Vec<_> = pictures.iter().map(|picture| bands(&picture.pixels)).collect();
    let widths: Vec<_> =
        pictures.iter().map(|picture| bands(&half_widths(picture).unwrap())).collect();
    let (mut all, mut covered, mut none, mut claimed, mut real) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (band, &truth) in truth.iter().enumerate() {
        let errors = || values.iter().map(|values| (values[band] - truth).abs());
        let mean_square = errors().map(|e| e * e).sum::<f64>() / pictures.len() as f64;
        // Sums in f32 differ from each other by this much even where nothing varies.
        let rounding = 2e-6 * truth;
        if mean_square.sqrt() <= rounding {
            continue;
        }
        for (error, widths) in errors().zip(&widths) {
            all += 1.0;
            covered += f64::from(error <= widths[band] + rounding);
            none += f64::from(widths[band] <= rounding);
            claimed += widths[band];
            real += 1.96 * mean_square.sqrt();
        }
    }
    Coverage { covered: covered / all, width: claimed / real, without_error: none / all }
}

/// A lamp with its penumbra, and silhouettes before a sky: 32 × 32 pixels, 16 seeds, 3 correlated samplers at their
/// default sets. About 47,000 values, of which those of a pixel depend on each other: the share is known to about 0.2 %:
/// the bounds are more than five standard errors off the 95.9 % that were found. Seen to fail with the normal quantile in place of Student's
/// (91.9 %), with 2 sets (98.4 %), and with each pixel's variance alone (84.0 %).
#[test]
fn the_truth_is_in_the_stated_interval() {
    let lamp =
        TriangleMesh::parallelogram(Vec3::new(-1.0, 2.0, -1.0), Vec3::X * 2.0, Vec3::Z * 2.0);
    let emission = Emission { radiance: Spectrum::splat(6.0), two_sided: false };
    let scene = ball_over_floor()
        .lamp("lamp", lamp, emission)
        .light(SkyLight::new(Spectrum::splat(0.5)))
        .build()
        .unwrap();
    let view = chapter_view(UVec2::splat(32));
    let settings = RenderSettings::new(SamplerSettings::default(), PathIntegrator::new(3));
    let most = SamplerSettings { spp: 2048, ..SamplerSettings::default() };
    let truth = &pictures((&scene, &view), &settings, most, 1)[0];
    for (name, kind) in CORRELATED {
        let sampler = SamplerSettings { kind, spp: 16, ..SamplerSettings::default() };
        let found = coverage(&pictures((&scene, &view), &settings, sampler, 16), truth);
        println!("{name}: {found:?}");
        assert!((0.945..0.975).contains(&found.covered), "{name}: {found:?}");
        assert!(found.without_error < 0.001, "{name}: {found:?}");
    }
}

/// The table in docs/measurements.md, at 48 × 48 pixels with 64 seeds. Two pictures at a time are compared.
#[test]
#[ignore = "half an hour; prints a table"]
fn coverage_of_the_shipped_scenes() {
    let independent = ("independent", SamplerKind::INDEPENDENT);
    for name in ["sky", "area", "box"] {
        let file = format!("{}/assets/dragon-{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let loaded = read_scene(file.as_ref(), &["film.resolution=[48,48]"]).unwrap();
        let (place, settings) = ((&loaded.scene, &loaded.view), &loaded.settings);
        let most = SamplerSettings { spp: 1 << 14, ..SamplerSettings::default() };
        let truth = &pictures(place, settings, most, 1)[0];
        for spp in [16, 64] {
            for (sampler, kind) in [independent].into_iter().chain(CORRELATED) {
                for replicates in [2, 4, 8, 16] {
                    if !kind.is_correlated() && replicates > 2 {
                        continue;
                    }
                    let settings_of = SamplerSettings { kind, spp, seed: 0, replicates };
                    let found = pictures(place, settings, settings_of, 64);
                    let failed = |pair: &[Image]| {
                        z_test(&pair[0], &pair[1]).unwrap().is_some_and(|test| test.failed > 0)
                    };
                    let failed = found.chunks(2).filter(|pair| failed(pair)).count();
                    let Coverage { covered, width, without_error } = coverage(&found, truth);
                    println!(
                        "| {name} | {spp} | {sampler} | {replicates} | {:.1} | {width:.2} | {:.2} | {failed} |",
                        100.0 * covered,
                        100.0 * without_error
                    );
                }
            }
        }
    }
}
