//! Rays that leave a surface do not hit its coplanar neighbours.

use lobe::TriangleMesh;
use lobe::accel::{Accel, Hit};
use lobe::glam::Vec3;
use lobe::interaction::SurfaceInteraction;

use super::answers::{assert_batch, assert_single, cut};
use crate::common::Rng;

/// Rays that leave a plane do not hit its other triangles. The corners are integers, so that they lie
/// in one plane exactly; far from the origin, points between them do not. Half of the rays start on edges
/// and corners, and half leave along the surface. Caught: the origin not moved, or by a sixteenth.
#[test]
fn no_triangle_hits_its_neighbours() {
    const SIDE: u32 = 32;
    for (number, offset) in [0.0, 1e3, 1e5].into_iter().enumerate() {
        let mut mesh = TriangleMesh::default();
        let corner = Vec3::new(offset, -3.0 * offset, 2.0 * offset);
        let (across, along) = (Vec3::new(3.0, 1.0, 2.0), Vec3::new(-1.0, 4.0, 1.0));
        for place in 0..(SIDE + 1) * (SIDE + 1) {
            let (i, j) = ((place % (SIDE + 1)) as f32, (place / (SIDE + 1)) as f32);
            mesh.positions.push(corner + i * across + j * along);
        }
        for cell in 0..SIDE * SIDE {
            let a = cell % SIDE + cell / SIDE * (SIDE + 1);
            let (b, c, d) = (a + 1, a + SIDE + 1, a + SIDE + 2);
            mesh.indices.extend([[a, b, d], [a, d, c]]);
        }
        let n = across.as_dvec3().cross(along.as_dvec3()).normalize();
        let accel = Accel::build(std::slice::from_ref(&mesh));
        let mut rays = Vec::new();
        for trial in 0..200_000 {
            let mut rng = Rng::new(821 + number as u64, trial);
            let mut b = rng.barycentric();
            match rng.below(4) {
                0 => b = [b[0], 1.0 - b[0], 0.0],
                1 => b = [0.0, 1.0, 0.0],
                _ => {}
            }
            let mut w = rng.direction_f64();
            if rng.below(2) == 0 {
                w = (w - w.dot(n) * n * (1.0 - 10.0_f64.powf(-6.0 * rng.f64()))).normalize();
            }
            let w = w.as_vec3();
            // A direction that rounding has laid into the plane may leave to either side.
            if w.as_dvec3().dot(n).abs() < 2e-7 {
                continue;
            }
            let triangle = rng.below(mesh.indices.len());
            let si = SurfaceInteraction::on_triangle(&mesh, triangle, b, w);
            let mut ray = si.spawn_ray(w);
            let target = si.p() + w * 10.0_f32.powf(4.0 * rng.f32() - 1.0);
            // A target that is closer to the plane than the point's error may be on either side.
            let height = |p: Vec3| (p - corner).as_dvec3().dot(n);
            if height(target).abs() > 2.0 * f64::from(si.p_error().length()) && rng.below(2) == 0 {
                ray = si.spawn_ray_to(target);
            }
            rays.push(ray);
        }
        let misses = vec![Hit::MISS; rays.len()];
        let order: Vec<usize> = (0..rays.len()).collect();
        for (trial, ray) in rays.iter().enumerate() {
            assert_single(&accel, ray, &Hit::MISS, &format!("offset {offset}, ray {trial}"));
        }
        for batch in cut(&order) {
            assert_batch(&accel, &rays, batch, &misses, &format!("offset {offset}"));
        }
    }
}
