//! Irradiance against closed forms, from samples of the light and from rays that meet it by chance.

use lobe::accel::Accel;
use lobe::glam::{DVec3, Vec3};
use lobe::light::{AreaLight, Light, SkyLight};
use lobe::sampling::uniform_hemisphere;
use lobe::{Spectrum, TriangleMesh};

use super::{L, lambert, rectangle, trace};
use crate::common::Rng;
use crate::common::meshes::soup;
use crate::common::stats::{assert_mean, mean};

const RED: f64 = 3.0;

/// The mean over samples of the light, of the red band, at `p` below +z.
fn by_light(light: &dyn Light, p: Vec3, rng: &mut Rng) -> (f64, f64) {
    mean((0..200_000).map(|_| {
        light.sample_li(p, rng.square()).map_or(0.0, |sample| {
            let red = f64::from(sample.li.to_array()[0]);
            red * f64::from(sample.wi.z.max(0.0)) / f64::from(sample.pdf)
        })
    }))
}

/// The same over uniform directions.
fn by_rays(light: &dyn Light, mesh: &TriangleMesh, p: Vec3, rng: &mut Rng) -> (f64, f64) {
    let accel = Accel::build(std::slice::from_ref(mesh));
    mean((0..200_000).map(|_| {
        let w = uniform_hemisphere::sample(rng.square());
        trace(&accel, mesh, p, w).map_or(0.0, |hit| {
            let red = f64::from(light.le(&hit).to_array()[0]);
            red * f64::from(w.z) / f64::from(uniform_hemisphere::pdf())
        })
    }))
}

/// Rectangles and pairs of triangles at many places above the horizon.
#[test]
fn polygons_give_what_lambert_says() {
    const TRIALS: usize = 24;
    for trial in 0..TRIALS {
        let mut rng = Rng::new(930, trial as u64);
        let x = rng.direction();
        let y = x.any_orthonormal_vector() * rng.within(0.2, 2.0);
        let mesh = match trial % 2 {
            0 => rectangle(-(x + y) / 2.0, x, y),
            // Two triangles of a fan from zero, of which none hides the other.
            _ => soup(&[[Vec3::ZERO, x, y], [Vec3::ZERO, y, -0.7 * x]]),
        };
        let side = 0.1 + rng.f32();
        let z = -(2.5 + side);
        let p = Vec3::new(rng.within(-1.0, 1.0), rng.within(-1.0, 1.0), z);
        let light = AreaLight::new(&mesh, L, true).unwrap();
        let triangles = 0..mesh.indices.len();
        let truth: f64 = triangles.map(|t| lambert(p, DVec3::Z, &mesh.corners(t)).abs()).sum();
        let (found, error) = by_light(&light, p, &mut rng);
        let what = format!("trial {trial}, by the light");
        assert_mean(found, error, RED * truth, 2 * TRIALS, &what);
        let (found, error) = by_rays(&light, &mesh, p, &mut rng);
        assert_mean(found, error, RED * truth, 2 * TRIALS, &format!("trial {trial}, by rays"));
    }
}

/// The whole sky over a surface: π L, and half of it from above.
#[test]
fn sky_gives_pi_times_its_radiance() {
    let light = SkyLight::new(Spectrum::new(3.0, 0.0, 0.0));
    let (found, error) = by_light(&light, Vec3::ZERO, &mut Rng::new(931, 0));
    assert_mean(found, error, 3.0 * std::f64::consts::PI, 1, "sky");
}

/// From within a closed light all directions end at it, and its own samples see it whole, once from
/// each: π L.
#[test]
fn closed_box_gives_pi_times_its_radiance() {
    let c = |i: usize| {
        Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * 2.0 - Vec3::ONE
    };
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles: Vec<[Vec3; 3]> = faces
        .iter()
        .flat_map(|f| [[c(f[0]), c(f[1]), c(f[2])], [c(f[0]), c(f[2]), c(f[3])]])
        .collect();
    // Shining inwards: inside is where the corners run counter-clockwise.
    let inward = |t: &[Vec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]).dot(t[0]) < 0.0;
    assert!(triangles.iter().all(inward));
    let mesh = soup(&triangles);
    let light = AreaLight::new(&mesh, L, false).unwrap();
    let mut rng = Rng::new(932, 0);
    let p = Vec3::new(0.3, -0.2, 0.1);
    let truth = RED * std::f64::consts::PI;
    let (found, error) = by_light(&light, p, &mut rng);
    assert_mean(found, error, truth, 2, "by the light");
    let (found, error) = by_rays(&light, &mesh, p, &mut rng);
    assert_mean(found, error, truth, 2, "by rays");
}
