//! The ends of a ray's range, to the bit.

use lobe::TriangleMesh;
use lobe::accel::{Accel, Hit};
use lobe::geometry::Ray;
use lobe::glam::Vec3;
use lobe::shape::ShearedRay;

use super::answers::{Loop, assert_answers};
use super::kinds::{Kind, many};
use crate::common::Rng;
use crate::common::meshes::{grid, lumpy, placed, single};

/// The ray with ranges that begin and end at the hit, and one float before or after it.
fn around(ray: &Ray, hit: &Hit) -> [Ray; 9] {
    let (t, below, above) = (hit.t, hit.t.next_down(), hit.t.next_up());
    let range = |t_min: f32, t_max: f32| Ray { t_min, t_max, ..*ray };
    [
        range(ray.t_min, t),
        range(ray.t_min, below),
        range(ray.t_min, above),
        range(t, ray.t_max),
        range(above, ray.t_max),
        range(below, ray.t_max),
        range(t, t),
        range(above, t),
        range(t, below),
    ]
}

/// A hit at t_max counts, and so does one at t_min; one float inside of them there is nothing. Caught: t_max
/// left out of the range, and t_min; a box not entered at the very t_max; either limit ignored.
#[test]
fn ranges_end_at_the_very_float() {
    let lump = lumpy(3, 8);
    let meshes = [
        lump.clone(),
        grid(8),
        placed(lump.clone(), 1e-3, Vec3::new(0.5, 2.0, 0.0)),
        TriangleMesh::default(),
        placed(lump, 1.5, Vec3::new(9.0, 1.0, -4.0)),
    ];
    let (accel, truth) = (Accel::build(&meshes), Loop::new(&meshes));
    for kind in Kind::ALL {
        let rays = many(kind, &meshes, 1200, 400);
        let hits = rays.iter().map(|ray| (ray, truth.closest(ray))).filter(|(_, hit)| hit.is_hit());
        let all: Vec<Ray> = hits.flat_map(|(ray, hit)| around(ray, &hit)).collect();
        assert!(all.len() > 9 * 20 || kind == Kind::TrianglePlane, "{kind:?}: {} rays", all.len());
        assert_answers(&accel, &truth, &all, &format!("{kind:?}"));
        // The loop only gives the same as the tree; these are the expected results.
        for (number, ranges) in all.chunks(9).enumerate() {
            let t = ranges[0].t_max;
            for (place, hit) in
                [(0, true), (1, false), (3, true), (6, true), (7, false), (8, false)]
            {
                let found = accel.intersect1(&ranges[place]);
                let same = found.is_hit() && found.t == t;
                assert_eq!(same, hit, "{kind:?}, hit {number}: {:?}: {found:?}", ranges[place]);
            }
        }
    }
}

/// Of equally near triangles the first counts: the lowest shape, and in it the lowest triangle. Wherever the
/// tree holds them, and whatever lies between. Caught: of equals the last that the walk meets, and the first.
#[test]
fn the_first_of_equals_is_hit() {
    let wall = grid(8);
    // The same wall six times, in each with its triangles in another order.
    let meshes: Vec<TriangleMesh> = (0..6)
        .map(|turn| {
            let mut mesh = wall.clone();
            mesh.indices.rotate_left(turn * 23);
            if turn % 2 == 1 {
                mesh.indices.reverse();
            }
            mesh
        })
        .collect();
    let (accel, truth) = (Accel::build(&meshes), Loop::new(&meshes));
    let mut rays = Vec::new();
    for x in -16..=16 {
        for z in -16..=16 {
            // Quarters: corners, edges and inner points of the cells.
            let at = Vec3::new(x as f32 / 4.0, 1.0, z as f32 / 4.0);
            for d in [Vec3::Y, Vec3::NEG_Y, Vec3::new(0.0, 2.0, 1.0), Vec3::new(0.5, -1.0, 0.25)] {
                rays.push(Ray::new(at - d, d));
            }
        }
    }
    assert_answers(&accel, &truth, &rays, "six walls");
    let mut later = 0;
    for ray in &rays {
        let hit = accel.intersect1(ray);
        assert!(hit.shape == 0, "{ray:?}: {hit:?}");
        later += u32::from(hit.triangle > 0);
    }
    assert!(later > 1000, "only {later} rays hit another triangle than the first");
}

/// No hit is behind the origin, even with a negative t_min: alone, in a batch, and of one triangle. Caught: t compared with
/// t_min alone, of one ray and of sixteen.
#[test]
fn nothing_behind_the_origin_is_hit() {
    // In the plane z = 2 x, with the origins of the rays in its box.
    let corners = [Vec3::new(-1.0, -1.0, -2.0), Vec3::new(1.0, -1.0, 2.0), Vec3::Y];
    let accel = Accel::build(&[single(corners)]);
    let truth = Loop::new(&[]);
    for t_min in [0.0, -1e-30, -5.0, f32::NEG_INFINITY] {
        let rays: Vec<Ray> = (0..64)
            .map(|i| {
                let o = Vec3::new(0.001 * i as f32, -0.5, 0.5);
                Ray { t_min, ..Ray::new(o, Vec3::new(0.1, 0.0, 1.0)) }
            })
            .collect();
        for ray in &rays {
            let hit = ShearedRay::new(ray).intersect(&corners, t_min, f32::INFINITY);
            assert_eq!(hit, None, "t_min {t_min}");
        }
        assert_answers(&accel, &truth, &rays, &format!("t_min {t_min}"));
    }
}

/// A hit whose distance is within its error bound is refused, and batches have the same bound as single rays: rays that
/// begin within 1e-5 of the triangle that they cross. Caught: a factor of the batches' bound smaller.
#[test]
fn hits_close_to_the_origin_are_refused_alike() {
    let (mut hits, mut all) = (0, 0);
    for trial in 0..100 {
        let mut rng = Rng::new(815, trial);
        let corners = [(); 3].map(|()| rng.direction() * rng.within(0.5, 2.0));
        let mesh = single(corners);
        let (accel, truth) =
            (Accel::build(std::slice::from_ref(&mesh)), Loop::new(std::slice::from_ref(&mesh)));
        let (n, along) = (mesh.geometric_normal(0), rng.direction());
        let d = along * n.dot(along).signum();
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let close = |_| {
            let aside = rng.direction().cross(n) * 0.02;
            let height = 10.0_f32.powf(rng.within(-8.0, -5.0));
            Ray::new(middle + aside - n * height, d + rng.direction() * 0.01)
        };
        let rays: Vec<Ray> = (0..64).map(close).collect();
        assert_answers(&accel, &truth, &rays, &format!("trial {trial}"));
        hits += rays.iter().filter(|ray| truth.closest(ray).is_hit()).count();
        all += rays.len();
    }
    assert!(hits > all / 10 && hits < all * 9 / 10, "{hits} hits of {all} rays");
}
