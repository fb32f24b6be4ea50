//! A scene built and rendered on a target without clock and threads:
//!
//! ```sh
//! cargo build --release -p lobe_wasm --target wasm32-unknown-unknown
//! node tests/wasm/run.mjs target/wasm32-unknown-unknown/release/lobe_wasm.wasm
//! ```
//!
//! Truth: a matte plane of albedo R, under a sky of radiance 1 and seen from above, reflects R everywhere.
//!
//! Breaks that this caught, one at a time: `Instant::now` called on this target (it traps in the builder); a limit of time
//! obeyed there, though no time passes (the render does not end).

use std::time::Duration;

use lobe::glam::Vec3;
use lobe::integrator::PathIntegrator;
use lobe::light::SkyLight;
use lobe::render::SamplerSettings;
use lobe::scene::{FilmSettings, View};
use lobe::{
    MatteMaterial, PerspectiveSettings, RenderOptions, RenderSettings, Scene, Spectrum,
    TriangleMesh, render,
};

/// The albedo of the plane, and so the mean of the picture.
const ALBEDO: f32 = 0.5;

fn picture() -> Result<Vec<Spectrum>, Box<dyn std::error::Error>> {
    let plane =
        TriangleMesh::parallelogram(Vec3::new(-9.0, 0.0, -9.0), 18.0 * Vec3::Z, 18.0 * Vec3::X);
    let scene = Scene::builder()
        .material("grey", MatteMaterial::new([ALBEDO; 3]))
        .shape("plane", plane, "grey")
        .light(SkyLight::new(Spectrum::WHITE))
        .build()?;
    let camera = PerspectiveSettings {
        eye: Vec3::new(0.0, 3.0, -1.0),
        look_at: Vec3::ZERO,
        ..PerspectiveSettings::default()
    };
    let view = View::perspective(&camera, FilmSettings::new(8, 8))?;
    let settings = RenderSettings::new(SamplerSettings::default(), PathIntegrator::new(4));
    // Time does not pass on this target, so a time limit must not make the render endless.
    let options = RenderOptions { time: Some(Duration::from_millis(1)), ..Default::default() };
    Ok(render(&scene, &view, &settings, &options)?.picture.color)
}

/// The mean of a rendered picture of 8 x 8 pixels; NaN if there is none.
// `no_mangle` is unsafe where two functions have one name.
#[unsafe(no_mangle)]
pub extern "C" fn mean() -> f64 {
    let sum =
        |colors: Vec<Spectrum>| colors.iter().map(|c| f64::from(c.max_component())).sum::<f64>();
    picture().map_or(f64::NAN, |colors| sum(colors) / 64.0)
}

/// The expected result of `mean`.
#[unsafe(no_mangle)]
pub extern "C" fn expected() -> f64 {
    f64::from(ALBEDO)
}
