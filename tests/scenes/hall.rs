//! A hall with pillars and rows of lamps below its ceiling.

use std::f32::consts::PI;

use lobe::glam::{UVec2, Vec3};
use lobe::light::{
    AreaLight, BoundingSphere, Light, LightHit, LightSample, LightSamples, Receivers,
};
use lobe::scene::SceneBuilder;
use lobe::{FilmSettings, MatteMaterial, PerspectiveSettings, Scene, Spectrum, TriangleMesh, View};

/// Half of its length and width.
const HALF: f32 = 20.0;
const HEIGHT: f32 = 4.0;
/// Of all lamps together, in W.
const POWER: f32 = 40_000.0;

/// A light whose place is kept from the choice among many, which is then by power alone.
pub struct Placeless<L>(pub L);

impl<L: Light> Light for Placeless<L> {
    fn is_delta(&self) -> bool {
        self.0.is_delta()
    }
    fn sample_li(&self, p: Vec3, u: lobe::glam::Vec2) -> Option<LightSample> {
        self.0.sample_li(p, u)
    }
    fn pdf_li(&self, hit: &LightHit) -> f32 {
        self.0.pdf_li(hit)
    }
    fn le(&self, hit: &LightHit) -> Spectrum {
        self.0.le(hit)
    }
    fn power(&self, scene: &BoundingSphere) -> Option<Spectrum> {
        self.0.power(scene)
    }
    fn sample_li_block(&self, receivers: &Receivers, samples: &mut LightSamples) {
        self.0.sample_li_block(receivers, samples);
    }
}

/// Adds a lamp, with or without its place.
pub fn lamp(
    builder: SceneBuilder,
    name: String,
    mesh: TriangleMesh,
    radiance: Spectrum,
    placeless: bool,
) -> SceneBuilder {
    let light = AreaLight::new(&mesh, radiance, false).expect("a lamp has an area");
    match placeless {
        true => builder.shape_with_light(name, mesh, None, Placeless(light)),
        false => builder.shape_with_light(name, mesh, None, light),
    }
}

/// The hall without lamps: floor, ceiling, two walls, and 4 x 4 pillars.
pub fn hall() -> SceneBuilder {
    let (x, y, z) = (Vec3::X * 2.0 * HALF, Vec3::Y * HEIGHT, Vec3::Z * 2.0 * HALF);
    let corner = Vec3::new(-HALF, 0.0, -HALF);
    let mut builder = Scene::builder()
        .material("stone", MatteMaterial::new([0.6, 0.55, 0.5]))
        .material("plaster", MatteMaterial::new([0.7, 0.7, 0.7]))
        .shape("floor", TriangleMesh::parallelogram(corner, z, x), "stone")
        .shape("ceiling", TriangleMesh::parallelogram(corner + y, x, z), "plaster")
        .shape("back", TriangleMesh::parallelogram(corner + z, x, y), "plaster")
        .shape("side", TriangleMesh::parallelogram(corner + x, y, z), "plaster");
    for i in 0..16 {
        let at = |i: i32| (i as f32 - 1.5) * 0.45 * HALF;
        let foot = Vec3::new(at(i % 4), 0.0, at(i / 4));
        let corners = [Vec3::X + Vec3::Z, Vec3::Z - Vec3::X, -Vec3::X - Vec3::Z, Vec3::X - Vec3::Z];
        for side in 0..4 {
            let [from, to] = [corners[side], corners[(side + 1) % 4]].map(|c| foot + 0.5 * c);
            let mesh = TriangleMesh::parallelogram(from, y, to - from);
            builder = builder.shape(format!("pillar {i} {side}"), mesh, "plaster");
        }
    }
    builder
}

/// The hall with `rows` x `rows` lamps that shine down, whose powers differ by up to a factor of ten.
pub fn lit_hall(rows: u32, placeless: bool) -> SceneBuilder {
    let spacing = 2.0 * HALF / rows as f32;
    let size = (0.3 * spacing).min(0.5);
    let mut builder = hall();
    for i in 0..rows * rows {
        let [x, z] = [i % rows, i / rows].map(|i| (i as f32 + 0.5) * spacing - HALF - size / 2.0);
        let corner = Vec3::new(x, HEIGHT - 0.05, z);
        let mesh = TriangleMesh::parallelogram(corner, Vec3::X * size, Vec3::Z * size);
        // The golden ratio's multiples are spread evenly over [0, 1).
        let strength = 10_f32.powf((i as f32 * 0.618_034).fract() - 0.6);
        let radiance = POWER * strength / (PI * size * size * (rows * rows) as f32);
        let color = Spectrum::new(1.0, 0.8, 0.6) * radiance;
        builder = lamp(builder, format!("lamp {i}"), mesh, color, placeless);
    }
    builder
}

/// From a corner across the hall.
pub fn hall_view(resolution: UVec2) -> View {
    let camera = PerspectiveSettings {
        eye: Vec3::new(-0.9 * HALF, 1.7, -0.9 * HALF),
        look_at: Vec3::new(0.0, 1.2, 0.0),
        ..PerspectiveSettings::default()
    };
    View::perspective(&camera, FilmSettings::new(resolution.x, resolution.y)).unwrap()
}
