//! Shadow rays are not blocked by the light and the surface at their ends.

use lobe::accel::Accel;
use lobe::glam::{DVec3, Vec3};
use lobe::interaction::SurfaceInteraction;
use lobe::light::{AreaLight, Light};

use super::{L, rectangle};
use crate::common::Rng;
use crate::common::meshes::{single, soup};

/// How far `p` is from the plane of a triangle.
fn height(p: Vec3, corners: [Vec3; 3]) -> f64 {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let normal: DVec3 = (b - a).cross(c - a).normalize();
    (p.as_dvec3() - a).dot(normal).abs()
}

/// 10,000 flat lights and as many surfaces of sizes and at places 10^U(-4, 4), ten rays from each to each. Left
/// out are those of which one is in the plane of the other, up to rounding.
#[test]
fn shadow_rays_are_not_blocked_by_their_ends() {
    let (mut lights, mut rays, mut blocked) = (0, 0, 0);
    for trial in 0.. {
        let mut rng = Rng::new(940, trial);
        let (at, size) = (rng.point(4.0), rng.coordinate(4.0).abs());
        let mesh = if trial % 2 == 0 {
            let x = rng.direction();
            let y = x.any_orthonormal_vector() * rng.within(0.1, 3.0);
            rectangle(at, size * x, size * y)
        } else {
            single([(); 3].map(|()| at + size * rng.direction()))
        };
        let Some(light) = AreaLight::new(&mesh, L, true) else { continue };
        let (at, size) = (rng.point(4.0), rng.coordinate(4.0).abs());
        let surface = soup(&[[(); 3].map(|()| at + size * rng.direction())]);
        if surface.geometric_normal(0) == Vec3::ZERO {
            continue;
        }
        let corners = surface.corners(0);
        let meshes = [mesh.clone(), surface.clone()];
        let accel = Accel::build(&meshes);
        for ray in 0..10 {
            let b = rng.barycentric();
            let si = SurfaceInteraction::on_triangle(&surface, 0, b, Vec3::Z);
            let Some(sample) = light.sample_li(si.p(), rng.square()) else { continue };
            let from = sample.from.unwrap();
            let largest = from.abs().max_element().max(si.p().abs().max_element());
            let rounding = 8.0 * f64::from(f32::EPSILON * largest);
            let planes = (0..mesh.indices.len()).map(|t| height(si.p(), mesh.corners(t)));
            if height(from, corners) < rounding || planes.fold(f64::MAX, f64::min) < rounding {
                continue;
            }
            rays += 1;
            let shadow = si.spawn_ray_to(from);
            if accel.occluded1(&shadow) {
                let by = accel.intersect1(&shadow);
                println!("trial {trial}, ray {ray}: blocked by {by:?}");
                blocked += 1;
            }
        }
        lights += 1;
        if lights == 10_000 {
            break;
        }
    }
    assert_eq!(blocked, 0, "of {rays}");
    assert!(rays > 50_000, "only {rays}");
}
