//! Scenes, samplers and a filter shared by several tests.
#![allow(dead_code, reason = "each test binary uses a part of it")]

pub mod hall;

use std::sync::Arc;

use lobe::film::Filter;
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::integrator::Integrator;
use lobe::render::{RenderSettings, SamplerSettings};
use lobe::sampling::{SampleId, Sampler, SamplerKind};
use lobe::scene::SceneBuilder;
use lobe::{FilmSettings, MatteMaterial, PerspectiveSettings, Scene, TriangleMesh, View};

/// One sample in the middle of each pixel, so that a closed form gives its value.
pub struct Middle;

impl Sampler for Middle {
    fn is_correlated(&self) -> bool {
        false
    }
    fn get_1d(&self, _id: SampleId, _dimension: u32) -> f32 {
        0.5
    }
    fn get_2d(&self, _id: SampleId, _dimension: u32) -> Vec2 {
        Vec2::splat(0.5)
    }
}

/// A rectangle in the plane y = `y`, from -`half` to `half` in x and z, facing up.
pub fn floor(y: f32, half: f32) -> TriangleMesh {
    let corner = |x: f32, z: f32| Vec3::new(x * half, y, z * half);
    TriangleMesh {
        positions: vec![corner(-1.0, 1.0), corner(1.0, 1.0), corner(-1.0, -1.0), corner(1.0, -1.0)],
        indices: vec![[0, 1, 2], [1, 3, 2]],
        ..TriangleMesh::default()
    }
}

/// A ball of unit radius about the origin, cut along `rows` circles of latitude: convex.
pub fn ball(rows: u32) -> TriangleMesh {
    star(rows, |_, _| 1.0)
}

/// The same with bumps.
pub fn lumpy_ball(rows: u32) -> TriangleMesh {
    star(rows, |theta, phi| 1.0 + 0.1 * (5.0 * theta).sin() * (7.0 * phi).cos())
}

/// A body, by its radius in the direction of polar angle and azimuth.
fn star(rows: u32, radius: impl Fn(f32, f32) -> f32) -> TriangleMesh {
    let columns = 2 * rows;
    let point = |row: u32, column: u32| {
        let theta = std::f32::consts::PI * row as f32 / rows as f32;
        let phi = std::f32::consts::TAU * (column % columns) as f32 / columns as f32;
        radius(theta, phi)
            * Vec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin())
    };
    let index = |row: u32, column: u32| match row {
        0 => 0,
        _ if row == rows => 1,
        _ => 2 + (row - 1) * columns + column % columns,
    };
    let mut mesh =
        TriangleMesh { positions: vec![point(0, 0), point(rows, 0)], ..Default::default() };
    for row in 1..rows {
        mesh.positions.extend((0..columns).map(|column| point(row, column)));
    }
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        let [a, b] = [index(row, column), index(row, column + 1)];
        let [c, d] = [index(row + 1, column), index(row + 1, column + 1)];
        mesh.indices.extend([[a, b, c], [b, d, c]].iter().filter(|t| t[0] != t[1] && t[1] != t[2]));
    }
    mesh
}

/// The chapter's camera.
pub fn chapter_camera() -> PerspectiveSettings {
    PerspectiveSettings {
        eye: Vec3::new(-3.0, 1.5, -3.0),
        look_at: Vec3::ZERO,
        ..Default::default()
    }
}

/// A view through the chapter's camera.
pub fn chapter_view(resolution: UVec2) -> View {
    view(&chapter_camera(), resolution)
}

/// A view on a film without crop, with a box filter.
pub fn view(camera: &PerspectiveSettings, resolution: UVec2) -> View {
    View::perspective(camera, FilmSettings::new(resolution.x, resolution.y)).unwrap()
}

/// An integrator of any type.
pub fn any(integrator: impl Integrator + 'static) -> Arc<dyn Integrator> {
    Arc::new(integrator)
}

/// Settings with this number of independent samples.
pub fn independent(spp: u32, integrator: impl Integrator + 'static) -> RenderSettings {
    let sampler =
        SamplerSettings { kind: SamplerKind::INDEPENDENT, spp, ..SamplerSettings::default() };
    RenderSettings::new(sampler, integrator)
}

/// A red ball over a blue floor, for the chapter's camera; the lights are left to the test.
pub fn ball_over_floor() -> SceneBuilder {
    Scene::builder()
        .material("red", MatteMaterial::new([0.8, 0.1, 0.2]))
        .material("blue", MatteMaterial::new([0.2, 0.3, 0.9]))
        .shape("ball", lumpy_ball(24), "red")
        .shape("floor", floor(-2.0, 6.0), "blue")
}

/// A filter of another crate, which has only what it must have: 1 - (x / 2)², the kernel of Epanechnikov.
#[derive(Debug)]
pub struct Parabola;

impl Filter for Parabola {
    fn radius(&self) -> f32 {
        2.0
    }

    fn profile(&self, x: f64) -> f64 {
        assert!((0.0..=2.0).contains(&x), "asked at {x}");
        1.0 - 0.25 * x * x
    }
}

/// A floor at y = -2.
pub fn floor_of(material: MatteMaterial) -> SceneBuilder {
    Scene::builder().material("floor", material).shape("floor", floor(-2.0, 6.0), "floor")
}

/// Looks from the origin straight down, on 2 × 2 units of the floor.
pub fn from_above() -> View {
    let camera = PerspectiveSettings {
        look_at: Vec3::NEG_Y,
        up: Vec3::Z,
        fov: 2.0 * 0.5_f32.atan().to_degrees(),
        ..PerspectiveSettings::default()
    };
    view(&camera, UVec2::splat(16))
}
