//! Custom textures: a checkered floor with ripples around a torus.
//!
//! `cargo run --release --example custom_texture [FILE.png]`

mod torus;

use std::path::Path;
use std::sync::Arc;

use lobe::glam::{Affine3A, Vec2, Vec3};
use lobe::image::{Display, Metadata, write_png};
use lobe::integrator::DirectIntegrator;
use lobe::interaction::SurfaceInteraction;
use lobe::material::DetailedMaterial;
use lobe::render::SamplerSettings;
use lobe::sampling::SamplerKind;
use lobe::texture::Texture;
use lobe::{
    FilmSettings, MatteMaterial, PerspectiveSettings, PointLight, RenderOptions, RenderSettings,
    Scene, Spectrum, TriangleMesh, View, render,
};

/// Squares of unit size in the xz plane.
struct Checkers(Spectrum, Spectrum);

impl Texture<Spectrum> for Checkers {
    fn evaluate(&self, si: &SurfaceInteraction) -> Spectrum {
        let square = si.p().x.floor() + si.p().z.floor();
        if square.rem_euclid(2.0) == 0.0 { self.0 } else { self.1 }
    }
}

/// Rings around the middle of the texture coordinates, as a displacement in scene units.
struct Ripples {
    height: f32,
    per_unit: f32,
}

impl Texture<f32> for Ripples {
    fn evaluate(&self, si: &SurfaceInteraction) -> f32 {
        let distance = si.uv().distance(Vec2::splat(0.5));
        self.height * (std::f32::consts::TAU * self.per_unit * distance).cos()
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1).unwrap_or("custom_texture.png".into());
    let mut torus = torus::torus(1.2, 0.4, 128);
    torus.transform(&Affine3A::from_translation(Vec3::new(0.0, -1.6, 0.0)));
    let floor = TriangleMesh {
        positions: [(-6, 6), (6, 6), (-6, -6), (6, -6)]
            .map(|(x, z)| Vec3::new(x as f32, -2.0, z as f32))
            .into(),
        uvs: vec![Vec2::new(0.0, 1.0), Vec2::ONE, Vec2::ZERO, Vec2::new(1.0, 0.0)],
        indices: vec![[0, 1, 2], [1, 3, 2]],
        ..TriangleMesh::default()
    };

    let checkers = Arc::new(Checkers(Spectrum::splat(0.7), Spectrum::new(0.1, 0.15, 0.3)));
    let ripples = Arc::new(Ripples { height: 0.02, per_unit: 20.0 });
    let scene = Scene::builder()
        .material("jade", MatteMaterial::new([0.1, 0.5, 0.25]).with_sigma(20.0))
        .material("pond", DetailedMaterial::new(MatteMaterial::new(checkers)).with_bump(ripples))
        .shape("torus", torus, "jade")
        .shape("floor", floor, "pond")
        .light(PointLight::new(Vec3::new(-2.0, 6.0, -7.0), Spectrum::splat(250.0)))
        .build()?;
    let camera = PerspectiveSettings {
        eye: Vec3::new(-3.0, 1.5, -3.0),
        look_at: Vec3::new(0.0, -0.8, 0.0),
        fov: 75.0,
        ..PerspectiveSettings::default()
    };
    let view = View::perspective(&camera, FilmSettings::default())?;
    let sampler =
        SamplerSettings { kind: SamplerKind::STRATIFIED, spp: 16, ..SamplerSettings::default() };
    let settings = RenderSettings::new(sampler, DirectIntegrator::default());
    let rendered = render(&scene, &view, &settings, &RenderOptions::default())?;
    write_png(Path::new(&file), &rendered.picture, Display::Srgb, &Metadata::default())?;
    println!("wrote {file} in {:.2} s", rendered.seconds);
    Ok(())
}
