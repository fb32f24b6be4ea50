//! The tree gives what a loop over all triangles gives, bit by bit.

use lobe::TriangleMesh;
use lobe::accel::{Accel, Hit};
use lobe::geometry::Ray;
use lobe::glam::Vec3;
use lobe::interaction::SurfaceInteraction;
use lobe::shape::ShearedRay;

use crate::common::Rng;
use crate::common::meshes::{lumpy, placed, soup};

/// The closest hit among all triangles; of equally close ones the first.
fn brute_force(meshes: &[TriangleMesh], ray: &Ray) -> Hit {
    let sheared = ShearedRay::new(ray);
    let mut closest = Hit::MISS;
    for (shape, mesh) in meshes.iter().enumerate() {
        for triangle in 0..mesh.indices.len() {
            if mesh.geometric_normal(triangle) == Vec3::ZERO {
                continue;
            }
            let found = sheared.intersect(&mesh.corners(triangle), ray.t_min, ray.t_max);
            if let Some(found) = found.filter(|found| found.t < closest.t) {
                closest =
                    Hit { t: found.t, b: found.b, shape: shape as u32, triangle: triangle as u32 };
            }
        }
    }
    closest
}

pub fn assert_same(accel: &Accel, meshes: &[TriangleMesh], ray: &Ray, what: &str) {
    let (hit, truth) = (accel.intersect1(ray), brute_force(meshes, ray));
    let bits = |hit: &Hit| (hit.t.to_bits(), hit.b.map(f32::to_bits), hit.shape, hit.triangle);
    assert_eq!(bits(&hit), bits(&truth), "{what}: {ray:?}: {hit:?}, all triangles give {truth:?}");
    assert_eq!(accel.occluded1(ray), truth.is_hit(), "{what}: {ray:?}");
}

/// Scenes: triangles of all sizes; a closed mesh twice, in the same place; a grid in a plane of the axes.
fn scenes() -> Vec<Vec<TriangleMesh>> {
    let mut rng = Rng::new(840, 0);
    let wild: Vec<[Vec3; 3]> = (0..300)
        .map(|_| {
            let (at, size) = (rng.point(1.0), rng.coordinate(1.0).abs());
            [(); 3].map(|()| at + size * rng.direction())
        })
        .collect();
    let grid: Vec<[Vec3; 3]> = (0..64)
        .flat_map(|i| {
            let (x, y) = ((i % 8) as f32 - 4.0, (i / 8) as f32 - 4.0);
            let at = |dx: f32, dy: f32| Vec3::new(x + dx, 1.0, y + dy);
            [[at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0)], [at(0.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]]
        })
        .collect();
    let lump = lumpy(3, 5);
    vec![
        vec![soup(&wild)],
        vec![lump.clone(), TriangleMesh::default(), lump.clone()],
        vec![soup(&grid), placed(lump, 0.5, Vec3::new(0.0, 2.0, 0.0))],
    ]
}

/// A ray of one of many kinds.
fn some_ray(rng: &mut Rng, meshes: &[TriangleMesh]) -> Ray {
    let mesh = loop {
        let mesh = &meshes[rng.below(meshes.len())];
        if !mesh.indices.is_empty() {
            break mesh;
        }
    };
    let triangle = rng.below(mesh.indices.len());
    let corners = mesh.corners(triangle);
    let b = rng.barycentric();
    let on_surface = b[0] * corners[0] + b[1] * corners[1] + b[2] * corners[2];
    let o = match rng.below(5) {
        0 => on_surface,
        1 => corners[0],
        2 => rng.point(3.0),
        3 => rng.point(1.0).round(),
        _ => 3.0 * rng.direction(),
    };
    let target = [on_surface, corners[0], 0.5 * (corners[0] + corners[1])][rng.below(3)];
    let mut ray = match rng.below(6) {
        // Towards the triangle, as from a camera.
        0 | 1 => Ray::new(o, target - o),
        // From the surface to a point, as shadow rays go.
        2 => {
            SurfaceInteraction::on_triangle(mesh, triangle, b, Vec3::Z).spawn_ray_to(rng.point(1.0))
        }
        // Along an axis, with zeros of both signs.
        3 => {
            let mut d = Vec3::new(0.0 * rng.sign(), 0.0 * rng.sign(), 0.0 * rng.sign());
            d[rng.below(3)] = rng.sign();
            let back = d * rng.f32() * 5.0;
            Ray::new(if rng.sign() > 0.0 { on_surface - back } else { corners[0] - back }, d)
        }
        // In a plane of the axes.
        4 => {
            let mut d = rng.direction();
            d[rng.below(3)] = 0.0 * rng.sign();
            Ray::new(o, d)
        }
        _ => Ray::new(o, rng.direction()),
    };
    if ray.d == Vec3::ZERO {
        ray.d = Vec3::X;
    }
    if rng.below(3) == 0 {
        ray.t_min = rng.f32() * 2.0;
    }
    if rng.below(3) == 0 {
        ray.t_max = ray.t_min + rng.f32() * 2.0;
    }
    ray
}

/// Caught: boxes that are not padded; -0 taken for forwards; t_min ignored by the triangle test, and t_max
/// by `occluded1`; a ray cut short by a thousandth.
#[test]
fn the_tree_gives_what_a_loop_gives() {
    for (number, meshes) in scenes().iter().enumerate() {
        let accel = Accel::build(meshes);
        let mut hits = 0;
        for trial in 0..40_000 {
            let mut rng = Rng::new(841 + number as u64, trial);
            let ray = some_ray(&mut rng, meshes);
            assert_same(&accel, meshes, &ray, &format!("scene {number}, trial {trial}"));
            hits += u32::from(accel.intersect1(&ray).is_hit());
        }
        assert!(hits > 8000, "scene {number}: only {hits} rays hit");
    }
}

/// Large scenes are built in parts: here about eight, one of which has a large triangle. Caught: nodes of a
/// part that refer to those of another; a part left out of the root.
#[test]
fn large_scenes_give_what_a_loop_gives() {
    let mut rng = Rng::new(846, 0);
    let small = (0..70_000).map(|_| {
        let at = rng.point(1.0);
        [(); 3].map(|()| at + 0.02 * rng.direction())
    });
    let small: Vec<[Vec3; 3]> = small.collect();
    let large =
        [[Vec3::new(-3.0, -1.0, -3.0), Vec3::new(3.0, -1.0, -3.0), Vec3::new(0.0, -1.0, 5.0)]];
    let meshes = [soup(&large), soup(&small)];
    let accel = Accel::build(&meshes);
    for trial in 0..500 {
        let ray = some_ray(&mut Rng::new(847, trial), &meshes);
        assert_same(&accel, &meshes, &ray, &format!("trial {trial}"));
    }
}

/// Batches give what single rays give. Caught: the last ray of a batch left out.
#[test]
fn batches_give_what_single_rays_give() {
    let meshes = &scenes()[1];
    let accel = Accel::build(meshes);
    for count in [0, 1, 7, 1000] {
        let rays: Vec<Ray> =
            (0..count).map(|trial| some_ray(&mut Rng::new(845, trial), meshes)).collect();
        let mut hits = vec![Hit::MISS; rays.len()];
        let mut occluded = vec![false; rays.len()];
        accel.intersect(&rays, &mut hits);
        accel.occluded(&rays, &mut occluded);
        for (i, ray) in rays.iter().enumerate() {
            assert_eq!(hits[i], accel.intersect1(ray), "ray {i} of {count}");
            assert_eq!(occluded[i], hits[i].is_hit(), "ray {i} of {count}");
        }
    }
}
