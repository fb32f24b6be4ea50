//! A custom light: a sky that is brighter overhead, with directions sampled in proportion.
//!
//! `cargo run --release --example custom_light [FILE.png]`

mod torus;

use std::path::Path;

use lobe::glam::{Vec2, Vec3};
use lobe::image::{Display, Metadata, write_png};
use lobe::light::{Light, LightHit, LightSample};
use lobe::sampling::cosine_hemisphere;
use lobe::{
    FilmSettings, MatteMaterial, PerspectiveSettings, RenderOptions, RenderSettings, Scene,
    Spectrum, TriangleMesh, View, render,
};

/// Radiance in proportion to the cosine with +y, and zero from below.
struct Overcast {
    zenith: Spectrum,
}

impl Light for Overcast {
    fn is_delta(&self) -> bool {
        false
    }

    fn is_infinite(&self) -> bool {
        true
    }

    fn sample_li(&self, _p: Vec3, u: Vec2) -> Option<LightSample> {
        let local = cosine_hemisphere::sample(u);
        let pdf = cosine_hemisphere::pdf(local.z);
        let wi = Vec3::new(local.x, local.z, local.y);
        let sample = LightSample::distant(self.zenith * local.z, wi, pdf);
        (pdf > 0.0).then_some(sample)
    }

    fn pdf_li(&self, hit: &LightHit) -> f32 {
        cosine_hemisphere::pdf(hit.wi.y.max(0.0))
    }

    fn le(&self, hit: &LightHit) -> Spectrum {
        self.zenith * hit.wi.y.max(0.0)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1).unwrap_or("custom_light.png".into());
    let floor =
        TriangleMesh::parallelogram(Vec3::new(-4.0, -0.5, -4.0), 8.0 * Vec3::Z, 8.0 * Vec3::X);
    let scene = Scene::builder()
        .material("clay", MatteMaterial::new([0.6, 0.3, 0.2]))
        .shape("torus", torus::torus(1.2, 0.5, 128), "clay")
        .shape("floor", floor, "clay")
        .light(Overcast { zenith: Spectrum::new(0.8, 1.0, 1.2) })
        .build()?;
    let camera = PerspectiveSettings {
        eye: Vec3::new(-2.0, 2.5, -3.0),
        look_at: Vec3::ZERO,
        fov: 65.0,
        ..PerspectiveSettings::default()
    };
    let view = View::perspective(&camera, FilmSettings::default())?;
    let rendered = render(&scene, &view, &RenderSettings::default(), &RenderOptions::default())?;
    write_png(Path::new(&file), &rendered.picture, Display::Srgb, &Metadata::default())?;
    println!("wrote {file} in {:.2} s", rendered.seconds);
    Ok(())
}
