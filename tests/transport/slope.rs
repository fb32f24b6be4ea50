//! How fast the error falls.

use lobe::glam::UVec2;
use lobe::integrator::PathIntegrator;
use lobe::light::SkyLight;
use lobe::render::SamplerSettings;
use lobe::sampling::SamplerKind;
use lobe::{RenderSettings, Spectrum};

use crate::scenes::{ball_over_floor, chapter_view};
use crate::statistics::{bands, picture};

const SEEDS: u64 = 8;

/// The root of the mean square error over the picture for 4, 8, ... 512 samples, against a reference of 32,768
/// others: the slope of its logarithm over that of the number, by least squares; the median of 8 seeds.
fn slope(kind: SamplerKind, reference: &[(f64, f64)]) -> f64 {
    let mut slopes: Vec<f64> = (0..SEEDS)
        .map(|seed| {
            let points: Vec<_> = (2..10)
                .map(|log2| {
                    let estimate = render(kind, 1 << log2, seed);
                    let squares = estimate.iter().zip(reference).map(|(a, b)| (a.0 - b.0).powi(2));
                    (f64::from(log2), 0.5 * squares.sum::<f64>().log2())
                })
                .collect();
            let count = points.len() as f64;
            let x = points.iter().map(|p| p.0).sum::<f64>() / count;
            let y = points.iter().map(|p| p.1).sum::<f64>() / count;
            let rise: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
            rise / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
        })
        .collect();
    slopes.sort_by(f64::total_cmp);
    0.5 * (slopes[3] + slopes[4])
}

fn render(kind: SamplerKind, spp: u32, seed: u64) -> Vec<(f64, f64)> {
    let replicates = if spp > 1 << 12 { 8 } else { 2 };
    let sampler = SamplerSettings { kind, spp, seed, replicates };
    let settings = RenderSettings::new(sampler, PathIntegrator::new(5));
    let scene = ball_over_floor().light(SkyLight::new(Spectrum::WHITE));
    bands(&picture(scene, &chapter_view(UVec2::splat(24)), &settings))
}

/// The error of independent samples falls with the power -0.5, that of Sobol points faster.
#[test]
fn sobol_converges_faster_under_the_sky() {
    let reference = render(SamplerKind::SOBOL, 1 << 15, 999);
    let [independent, sobol] =
        [SamplerKind::INDEPENDENT, SamplerKind::SOBOL].map(|kind| slope(kind, &reference));
    println!("slopes: independent {independent:.3}, sobol {sobol:.3}");
    assert!((independent + 0.5).abs() < 0.03, "independent {independent}");
    assert!(sobol < -0.6, "sobol {sobol}");
}
