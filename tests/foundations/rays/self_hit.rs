//! Rays that leave a triangle do not hit it.

use lobe::TriangleMesh;
use lobe::accel::Accel;
use lobe::geometry::Ray;
use lobe::glam::Vec3;
use lobe::interaction::SurfaceInteraction;

use crate::common::Rng;
use crate::common::meshes::single;

/// A hit on a random triangle, found by a ray as a renderer finds it.
fn hit(rng: &mut Rng, accel: &Accel, corners: [Vec3; 3]) -> Option<(Ray, [f32; 3])> {
    let [b0, b1, b2] = rng.barycentric();
    let target = b0 * corners[0] + b1 * corners[1] + b2 * corners[2];
    let o = rng.point(8.0);
    let ray = Ray::new(o, (target - o).normalize());
    let hit = accel.intersect1(&ray);
    hit.is_hit().then_some((ray, hit.b))
}

/// 1000 triangles with coordinates 10^U(-8, 8), from each 10,000 rays from ten hits: half of them to a
/// direction, a few along the surface, half of them to a point. Caught: the origin moved to the wrong side;
/// the bound on the error of t left out, or in units that suit directions of unit length alone.
#[test]
fn no_triangle_hits_itself() {
    let (mut spawned, mut triangles) = (0, 0);
    for trial in 0.. {
        let mut rng = Rng::new(820, trial);
        let corners = [(); 3].map(|()| rng.point(8.0));
        let mesh = single(corners);
        let accel = Accel::build(std::slice::from_ref(&mesh));
        let mut hits = 0;
        for _ in 0..20 {
            let Some((ray, b)) = hit(&mut rng, &accel, corners) else { continue };
            hits += 1;
            let si = SurfaceInteraction::on_triangle(&mesh, 0, b, -ray.d);
            for _ in 0..1000 {
                let mut w = rng.direction();
                if rng.below(8) == 0 {
                    w = (w - w.dot(si.n()) * si.n() * (1.0 - rng.coordinate(8.0).abs().min(1.0)))
                        .normalize();
                }
                let to_point = rng.below(2) == 0;
                let ray = if to_point { si.spawn_ray_to(rng.point(8.0)) } else { si.spawn_ray(w) };
                let again = accel.intersect1(&ray);
                assert!(!again.is_hit(), "trial {trial}: {corners:?}, b {b:?}, {ray:?}: {again:?}");
                spawned += 1;
            }
            if hits == 10 {
                break;
            }
        }
        triangles += u32::from(hits > 0);
        if triangles == 1000 {
            break;
        }
    }
    assert!(spawned > 5_000_000, "only {spawned} rays");
}

/// Rays that leave a plane do not hit its other triangles. The corners are whole numbers, so that they lie
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
        for trial in 0..300_000 {
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
            // A direction that rounding has laid into the plane leaves to either side.
            if w.as_dvec3().dot(n).abs() < 2e-7 {
                continue;
            }
            let triangle = rng.below(mesh.indices.len());
            let si = SurfaceInteraction::on_triangle(&mesh, triangle, b, w);
            let mut ray = si.spawn_ray(w);
            let target = si.p() + w * 10.0_f32.powf(4.0 * rng.f32() - 1.0);
            // A target closer to the plane than the point may be is on neither side of it.
            let height = |p: Vec3| (p - corner).as_dvec3().dot(n);
            if height(target).abs() > 2.0 * f64::from(si.p_error().length()) && rng.below(2) == 0 {
                ray = si.spawn_ray_to(target);
            }
            let hit = accel.intersect1(&ray);
            assert!(!hit.is_hit(), "offset {offset}, trial {trial}: {ray:?}: {hit:?}");
        }
    }
}
