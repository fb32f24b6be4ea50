//! A thousand random scenes, most of them absurd: every sample is finite.

use lobe::glam::{UVec2, Vec3};
use lobe::image::{Encoding, Image};
use lobe::integrator::{DirectIntegrator, PathIntegrator};
use lobe::light::{DistantLight, EnvironmentLight, LightStrategy, SkyLight, SpotLight};
use lobe::render::SamplerSettings;
use lobe::sampling::SamplerKind;
use lobe::scene::{Emission, Scene};
use lobe::scene_file::{LoadedScene, read_scene};
use lobe::{
    MatteMaterial, PerspectiveSettings, PointLight, RenderOptions, RenderSettings, Spectrum,
    TriangleMesh, View, render,
};

use crate::scenes::{any, view};

/// SplitMix64: a generator for each scene.
struct Rng(u64);

impl Rng {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }
    fn f32(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1 << 24) as f32
    }
    fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }
    fn within(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.f32()
    }
    fn vector(&mut self) -> Vec3 {
        Vec3::new(self.within(-1.0, 1.0), self.within(-1.0, 1.0), self.within(-1.0, 1.0))
    }
    /// A point in the unit cube, one time in three on its grid of thirds: on faces, edges and corners of others.
    fn place(&mut self) -> Vec3 {
        let p = self.vector();
        if self.below(3) == 0 { (p * 3.0).round() / 3.0 } else { p }
    }
    fn light(&mut self) -> Spectrum {
        let l = 10_f32.powf(self.within(-6.0, 6.0));
        Spectrum::new(l, l * self.f32(), if self.below(4) == 0 { 0.0 } else { l })
    }
    fn emission(&mut self) -> Emission {
        Emission { radiance: self.light(), two_sided: self.below(2) == 0 }
    }
}

/// A rectangle, a closed box, or a handful of triangles, some of them needles, some without area.
fn mesh(rng: &mut Rng) -> TriangleMesh {
    match rng.below(3) {
        0 => {
            let (a, b) = (rng.vector(), rng.vector());
            let edge_v = if rng.below(2) == 0 { a.cross(b) } else { b };
            TriangleMesh::parallelogram(rng.place(), a, edge_v)
        }
        1 => {
            let (corner, size) = (rng.place(), rng.vector().abs() + 1e-3);
            let mut mesh = TriangleMesh::default();
            for axis in 0..3 {
                let [u, v] = [(axis + 1) % 3, (axis + 2) % 3].map(|i| Vec3::AXES[i] * size);
                for (at, edges) in [(Vec3::ZERO, [v, u]), (Vec3::AXES[axis] * size, [u, v])] {
                    let first = mesh.positions.len() as u32;
                    let face = TriangleMesh::parallelogram(corner + at, edges[0], edges[1]);
                    mesh.positions.extend(face.positions);
                    mesh.indices.extend(face.indices.iter().map(|t| t.map(|i| i + first)));
                }
            }
            mesh
        }
        _ => {
            let count = 1 + rng.below(12) as u32;
            let mut mesh = TriangleMesh::default();
            for i in 0..count {
                let a = rng.place();
                let b = if rng.below(8) == 0 { a } else { rng.place() };
                let thin = if rng.below(4) == 0 { 1e-6 } else { 1.0 };
                mesh.positions.extend([a, b, a + (b - a) * rng.f32() + rng.vector() * thin]);
                mesh.indices.push([3 * i, 3 * i + 1, 3 * i + 2]);
            }
            if rng.below(2) == 0 {
                mesh.normals =
                    mesh.positions.iter().map(|_| rng.vector().normalize_or_zero()).collect();
            }
            mesh
        }
    }
}

/// A map of a few pixels, some of them black.
fn environment(rng: &mut Rng) -> EnvironmentLight {
    let size = UVec2::new(1 + rng.below(5) as u32, 1 + rng.below(5) as u32);
    let pixel = |_| if rng.below(3) == 0 { Spectrum::BLACK } else { rng.light() };
    let pixels = (0..size.x * size.y).map(pixel).collect();
    let encoding = Encoding::Linear;
    let image = Image { size, pixels, variance: None, degrees_of_freedom: None, encoding };
    EnvironmentLight::new(&image, &Default::default()).unwrap()
}

fn scene(trial: u64) -> (Scene, View, RenderSettings) {
    let rng = &mut Rng(trial.wrapping_mul(0x2545_f491_4f6c_dd1d));
    let scale = 10_f32.powf(rng.within(-4.0, 4.0));
    let shift = if rng.below(3) == 0 { rng.vector() * scale * 1e3 } else { Vec3::ZERO };
    let at = |p: Vec3| p * scale + shift;
    let placed = |mut mesh: TriangleMesh| {
        mesh.positions.iter_mut().for_each(|p| *p = at(*p));
        mesh
    };
    let kinds = [
        SamplerKind::INDEPENDENT,
        SamplerKind::STRATIFIED,
        SamplerKind::SOBOL,
        SamplerKind::BLUE_NOISE,
    ];
    let strategies =
        [LightStrategy::Auto, LightStrategy::Mis, LightStrategy::Light, LightStrategy::Bsdf];
    let strategy = strategies[rng.below(4)];
    let integrator = match rng.below(3) {
        0 => any(DirectIntegrator { strategy }),
        _ => {
            let (max_depth, roulette) = (rng.below(12) as u32, rng.below(2) == 0);
            any(PathIntegrator { max_depth, roulette, strategy })
        }
    };
    // Inside of things, on them, or well away from all.
    let mut eye = rng.place();
    if rng.below(2) == 0 {
        eye = eye.normalize_or(Vec3::X) * 4.0;
    }
    let sampler = SamplerSettings { kind: kinds[rng.below(4)], spp: 4, seed: trial, replicates: 2 };
    let matte = |rng: &mut Rng| {
        let kd = rng.vector().abs().round() * rng.f32();
        let matte = MatteMaterial::new(kd.to_array());
        if rng.below(2) == 0 { matte.with_sigma(90.0 * rng.f32()) } else { matte }
    };
    let camera = PerspectiveSettings {
        eye: at(eye),
        look_at: at(eye + (rng.vector() * 0.1 - eye).normalize_or(Vec3::Z)),
        up: Vec3::new(0.1, 1.0, 0.2),
        ..PerspectiveSettings::default()
    };
    let mut builder = Scene::builder().material("a", matte(rng)).material("b", matte(rng));
    for i in 0..1 + rng.below(4) {
        let (name, mesh) = (i.to_string(), placed(mesh(rng)));
        let material = ["a", "b"][rng.below(2)];
        builder = match rng.below(3) {
            0 => builder.shape(name, mesh, material),
            1 => builder.lamp(name, mesh, rng.emission()),
            _ => builder.glowing_shape(name, mesh, material, rng.emission()),
        };
    }
    for _ in 0..rng.below(3) {
        builder = match rng.below(5) {
            0 => builder.light(SkyLight::new(rng.light())),
            3 => builder.light(environment(rng)),
            4 => {
                let (p, direction) = (at(rng.place()), rng.vector().normalize_or(Vec3::Y));
                let cone = 180.0 * (1.0 - rng.f32());
                let start = cone * [rng.f32(), 0.0, 1.0][rng.below(3)];
                builder.light(SpotLight::new(p, direction, rng.light(), cone, start).unwrap())
            }
            1 => {
                let direction = rng.vector().normalize_or(Vec3::Y);
                builder.light(DistantLight::new(direction, rng.light()).unwrap())
            }
            // On surfaces too.
            _ => builder.light(PointLight::new(at(rng.place()), rng.light())),
        };
    }
    let scene = builder.build().unwrap_or_else(|error| panic!("scene {trial}: {error}"));
    (scene, view(&camera, UVec2::splat(12)), RenderSettings::new(sampler, integrator))
}

/// The scenes that come with the crate, small.
#[test]
fn no_sample_of_a_shipped_scene_is_not_finite() {
    for entry in std::fs::read_dir("assets").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let loaded = read_scene(&path, &["film.resolution=[80,60]", "sampler.spp=16"]).unwrap();
        let LoadedScene { scene, view, settings, .. } = loaded;
        let rendered = render(&scene, &view, &settings, &RenderOptions::default()).unwrap();
        let path = path.display();
        assert_eq!((rendered.non_finite, rendered.counters.rejected), (0, 0), "{path}");
        assert!(rendered.picture.color.iter().any(|color| !color.is_black()), "{path}");
    }
}

/// None of a thousand scenes has a sample that is not finite, rejected by a Bsdf, or negative.
#[test]
fn no_sample_is_not_finite() {
    let mut lit = 0;
    for trial in 0..1000 {
        let (scene, view, settings) = scene(trial);
        let rendered = render(&scene, &view, &settings, &RenderOptions::default()).unwrap();
        assert_eq!(rendered.non_finite, 0, "scene {trial}");
        assert_eq!(rendered.counters.rejected, 0, "scene {trial}");
        let values = || rendered.picture.color.iter().flat_map(|c| c.to_array());
        assert!(values().all(|value| value >= 0.0), "scene {trial}");
        lit += u32::from(values().any(|value| value > 0.0));
    }
    // Most of the scenes are lit: a black picture would test nothing.
    assert!(lit > 600, "only {lit} scenes are not black");
}
