//! A custom camera, sampler and integrator: the inside of a torus through a fisheye lens, where brightness is
//! distance.
//!
//! `cargo run --release --example custom_camera [FILE.png]`

mod torus;

use std::f32::consts::FRAC_PI_2;
use std::path::Path;

use lobe::camera::Camera;
use lobe::geometry::Ray;
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::image::{Display, Metadata, write_png};
use lobe::integrator::{Estimator, Integrator, Wave};
use lobe::render::{Sampling, render_with};
use lobe::sampling::{SampleId, Sampler};
use lobe::{FilmSettings, MatteMaterial, RenderOptions, Scene, Spectrum, View};

/// Equidistant fisheye that looks along +z: the angle to +z grows linearly with the distance from the middle of the
/// image, to 90 degrees at the edges.
struct Fisheye {
    resolution: UVec2,
    eye: Vec3,
}

impl Camera for Fisheye {
    fn resolution(&self) -> UVec2 {
        self.resolution
    }

    fn has_lens(&self) -> bool {
        false
    }

    fn generate_ray(&self, pixel: UVec2, offset: Vec2, _lens: Vec2) -> Ray {
        let p = (pixel.as_vec2() + offset) / self.resolution.as_vec2() * 2.0 - 1.0;
        let angle = p.length() * FRAC_PI_2;
        let across = p.normalize_or_zero() * angle.sin();
        Ray::new(self.eye, Vec3::new(across.x, -across.y, angle.cos()))
    }
}

/// Roberts's R2 sequence, shifted in the unit square by pixel and dimension.
struct Quasirandom;

impl Sampler for Quasirandom {
    // The samples of a pixel are correlated, so their variance does not give the error of their mean.
    fn is_correlated(&self) -> bool {
        true
    }

    fn get_1d(&self, id: SampleId, dimension: u32) -> f32 {
        self.get_2d(id, dimension).x
    }

    fn get_2d(&self, id: SampleId, dimension: u32) -> Vec2 {
        let [x, y] = id.pixel.to_array().map(f64::from);
        let start = 0.618_034 * x + 0.414_214 * y + 0.732_051 * f64::from(dimension + 7 * id.set);
        let coordinate =
            |step: f64, start: f64| (start + step * f64::from(id.index)).fract() as f32;
        let point =
            Vec2::new(coordinate(0.754_877_666, start), coordinate(0.569_840_291, 3.3 * start));
        point.min(Vec2::splat(1.0 - f32::EPSILON / 2.0))
    }
}

/// Distance along the ray, as a brightness.
struct Depth {
    brightness: f32,
}

impl Integrator for Depth {
    fn prepare<'a>(&'a self, _: &'a Scene) -> Box<dyn Estimator + 'a> {
        Box::new(DepthEstimator(self.brightness))
    }
}

struct DepthEstimator(f32);

impl Estimator for DepthEstimator {
    fn shade(&self, _: &dyn Sampler, wave: &mut Wave) {
        for (radiance, hit) in wave.radiance.iter_mut().zip(&wave.hits) {
            if hit.is_hit() {
                *radiance += Spectrum::splat(self.0 * hit.t);
            }
        }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1).unwrap_or("custom_camera.png".into());
    let scene = Scene::builder()
        .material("clay", MatteMaterial::new([0.5; 3]))
        .shape("torus", torus::torus(1.2, 0.5, 128), "clay")
        .build()?;
    let camera = Fisheye { resolution: UVec2::splat(500), eye: Vec3::new(-1.2, 0.0, 0.0) };
    let view = View::new(camera, FilmSettings::new(500, 500))?;
    let sampling = Sampling::new(&Quasirandom, 16);
    let depth = Depth { brightness: 0.3 };
    let rendered = render_with(&scene, &view, &depth, sampling, &RenderOptions::default())?;
    write_png(Path::new(&file), &rendered.picture, Display::Srgb, &Metadata::default())?;
    println!("wrote {file} in {:.2} s", rendered.seconds);
    Ok(())
}
