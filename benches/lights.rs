//! Error of equal time with many lights: `cargo bench --bench lights`.
//!
//! A hall with 1, 100 and 10,000 lamps, rendered by paths of four reflections. One lamp of several is selected at each hit by
//! power alone, or by the tree. Both methods take turns. A line tells the relative mean squared error of a render of so many
//! seconds: that of all rounds, times the time of a round over so many seconds, since the error of independent samples falls with time.

#[path = "../tests/scenes/hall.rs"]
mod hall;

use lobe::glam::UVec2;
use lobe::image::Picture;
use lobe::integrator::PathIntegrator;
use lobe::render::SamplerSettings;
use lobe::sampling::SamplerKind;
use lobe::{RenderOptions, RenderSettings, Scene, render};

const RESOLUTION: UVec2 = UVec2::new(160, 90);
const SECONDS: f64 = 10.0;
const ROUNDS: u64 = 3;

fn main() {
    println!(
        "{:>8} {:>10} {:>10} {:>12} {:>10} {:>14}",
        "lamps", "selected", "build / s", "spp", "spp / s", "relMSE at 10 s"
    );
    for rows in [1, 10, 100] {
        let scenes =
            [true, false].map(|placeless| hall::lit_hall(rows, placeless).build().unwrap());
        let reference = picture(&scenes[1], 1024, 1_000_000).0;
        let mut results = [[0.0; 3]; 2];
        for round in 0..ROUNDS {
            for (scene, result) in scenes.iter().zip(&mut results) {
                let (picture, seconds, set_up) = picture(scene, 64, round);
                let error = relative_mse(&picture, &reference) * seconds / SECONDS;
                for (sum, value) in result.iter_mut().zip([error, seconds, set_up]) {
                    *sum += value / ROUNDS as f64;
                }
            }
        }
        for (name, [error, seconds, set_up]) in ["by power", "by tree"].iter().zip(results) {
            let (lamps, speed) = (rows * rows, 64.0 / seconds);
            println!(
                "{lamps:>8} {name:>10} {set_up:>10.4} {:>12} {speed:>10.2} {error:>14.3e}",
                64
            );
        }
    }
}

/// A picture, and the seconds that it and its preparation took.
fn picture(scene: &Scene, spp: u32, seed: u64) -> (Picture, f64, f64) {
    let sampler = SamplerSettings { kind: SamplerKind::INDEPENDENT, spp, seed, replicates: 4 };
    let integrator = PathIntegrator::new(4);
    let start = std::time::Instant::now();
    drop(lobe::integrator::Integrator::prepare(&integrator, scene));
    let set_up = start.elapsed().as_secs_f64();
    let settings = RenderSettings::new(sampler, integrator);
    let rendered =
        render(scene, &hall::hall_view(RESOLUTION), &settings, &RenderOptions::default()).unwrap();
    (rendered.picture, rendered.seconds, set_up)
}

/// Mean of the squared error over the squared value, plus a hundredth of the squared mean.
fn relative_mse(picture: &Picture, reference: &Picture) -> f64 {
    let values = |picture: &Picture| -> Vec<f64> {
        picture.color.iter().flat_map(|c| c.to_array().map(f64::from)).collect()
    };
    let (a, b) = (values(picture), values(reference));
    let mean = b.iter().sum::<f64>() / b.len() as f64;
    let of = |(a, b): (&f64, &f64)| (a - b).powi(2) / (b * b + 0.01 * mean * mean);
    a.iter().zip(&b).map(of).sum::<f64>() / a.len() as f64
}
