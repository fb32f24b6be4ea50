//! Power, and the lights from infinity.

use lobe::accel::Accel;
use lobe::glam::{Vec2, Vec3};
use lobe::light::{AreaLight, BoundingSphere, DistantLight, Light, LightHit, SkyLight};
use lobe::sampling::uniform_hemisphere;
use lobe::{MatteMaterial, Scene, TriangleMesh};

use super::{L, rectangle, trace};
use crate::common::Rng;
use crate::common::meshes::{lumpy, placed};
use crate::common::stats::{assert_mean, mean};

const PI: f64 = std::f64::consts::PI;
const SCENE: BoundingSphere = BoundingSphere { center: Vec3::X, radius: 2.5 };

/// A uniform random line through a ball around the light hits it in proportion to its power: the integral over
/// area and solid angle of L cos θ, by rays from outside.
#[test]
fn power_of_areas_is_what_leaves_them() {
    let quad = rectangle(Vec3::new(-0.5, 0.0, 0.0), Vec3::X, 0.5 * Vec3::Y);
    let meshes = [quad, placed(lumpy(2, 3), 0.4, Vec3::ZERO)];
    for (run, mesh) in meshes.into_iter().enumerate() {
        let accel = Accel::build(std::slice::from_ref(&mesh));
        for two_sided in [false, true] {
            let light = AreaLight::new(&mesh, L, two_sided).unwrap();
            // Away from each point of the surface, ignoring occlusion.
            let mut rng = Rng::new(950, run as u64);
            let areas: Vec<f32> = (0..mesh.indices.len())
                .map(|t| {
                    let [a, b, c] = mesh.corners(t);
                    (b - a).cross(c - a).length() / 2.0
                })
                .collect();
            let sides = if two_sided { 2 } else { 1 };
            let (sum, error) = mean((0..100_000).map(|_| {
                let t = rng.below(areas.len());
                let [a, b, c] = mesh.corners(t);
                let [x, y, z] = rng.barycentric();
                let (p, n) = (x * a + y * b + z * c, mesh.geometric_normal(t));
                let mut out = 0.0;
                for side in 0..sides {
                    let n = if side == 0 { n } else { -n };
                    let w = uniform_hemisphere::sample(rng.square());
                    let w = lobe::geometry::Frame::from_normal(n).to_world(w);
                    // Seen from just above: the ray back along w.
                    let hit = trace(&accel, &mesh, p + 1e-3 * w, -w);
                    let seen = hit.map_or(0.0, |hit| f64::from(light.le(&hit).to_array()[0]));
                    out += seen * f64::from(n.dot(w) * areas[t]) * 2.0 * PI;
                }
                out * areas.len() as f64
            }));
            let power = f64::from(light.power(&SCENE).unwrap().to_array()[0]);
            assert_mean(sum, error, power, 4, &format!("mesh {run}, two-sided {two_sided}"));
        }
    }
}

/// The radiance through all lines that meet a ball: integral over directions of the disk's area.
#[test]
fn lights_from_infinity_shine_through_the_scene() {
    let sky = SkyLight::new(L);
    assert!(sky.is_infinite() && !sky.is_delta() && !sky.is_worth_sampling());
    let mut rng = Rng::new(951, 0);
    let (sum, error) = mean((0..100_000).map(|_| {
        // A point of the sphere, and a direction inwards from it.
        let n = -rng.direction();
        let w = rng.direction();
        let hit = LightHit::outside(SCENE.center, -w);
        let area = 4.0 * PI * f64::from(SCENE.radius).powi(2);
        f64::from(sky.le(&hit).to_array()[0] * n.dot(w).max(0.0)) * area * 4.0 * PI
    }));
    assert_mean(sum, error, f64::from(sky.power(&SCENE).unwrap().to_array()[0]), 2, "sky");

    let sun = DistantLight::new(Vec3::new(1.0, 5.0, -2.0), L).unwrap();
    assert!(sun.is_delta() && !sun.is_infinite());
    let (sum, error) = mean((0..100_000).map(|_| {
        let n = rng.direction();
        let sample = sun.sample_li(SCENE.center + SCENE.radius * n, rng.square()).unwrap();
        let area = 4.0 * PI * f64::from(SCENE.radius).powi(2);
        f64::from(sample.li.to_array()[0] * n.dot(sample.wi).max(0.0)) * area
    }));
    assert_mean(sum, error, f64::from(sun.power(&SCENE).unwrap().to_array()[0]), 2, "sun");
}

/// Unit directions, no origin, and a density that is the same for samples and for rays.
#[test]
fn directions_are_unit_vectors() {
    let sky = SkyLight::new(L);
    for trial in 0..100_000 {
        let mut rng = Rng::new(952, trial);
        let edge = [0.0, 0.5, 1.0 - 1.0 / (1 << 24) as f32, rng.f32()];
        let sample = sky.sample_li(Vec3::ZERO, Vec2::new(edge[rng.below(4)], rng.f32())).unwrap();
        assert!((sample.wi.as_dvec3().length() - 1.0).abs() < 2e-7, "trial {trial}");
        let hit = LightHit::outside(Vec3::ZERO, sample.wi);
        assert_eq!((sky.pdf_li(&hit), sky.le(&hit), sample.from), (sample.pdf, sample.li, None));
        let towards = rng.point(30.0);
        let sun = DistantLight::new(towards, L).unwrap().sample_li(Vec3::ONE, Vec2::ZERO).unwrap();
        assert!((sun.wi.as_dvec3().length() - 1.0).abs() < 2e-7, "trial {trial}: {towards}");
        assert!(sun.wi.dot(towards) > 0.0 && sun.from.is_none() && sun.pdf == 1.0);
    }
    for bad in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
        assert!(DistantLight::new(bad, L).is_none(), "{bad}");
    }
}

/// The sphere reaches the corners of the bounds, whose diagonal is 3, 4 and 12 long. Seen to fail with the longest side in
/// place of the diagonal.
#[test]
fn the_bounding_sphere_reaches_the_corners() {
    let mesh = TriangleMesh {
        positions: vec![Vec3::ZERO, Vec3::new(3.0, 4.0, 0.0), Vec3::new(3.0, 4.0, 12.0)],
        indices: vec![[0, 1, 2]],
        ..TriangleMesh::default()
    };
    let scene = Scene::builder()
        .material("m", MatteMaterial::new([0.5; 3]))
        .shape("s", mesh, "m")
        .build()
        .unwrap();
    let sphere = scene.bounding_sphere();
    assert_eq!((sphere.center, sphere.radius), (Vec3::new(1.5, 2.0, 6.0), 6.5));
}
