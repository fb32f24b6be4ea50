//! Rays that leave a triangle do not hit it.

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
/// direction, a few along the surface, half of them to a point. Caught: the error bound divided by 16;
/// the origin moved to the wrong side; the origin not moved at all.
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
