//! Input that no one means: no panic, and no wrong hit.

use lobe::TriangleMesh;
use lobe::accel::Accel;
use lobe::geometry::Ray;
use lobe::glam::Vec3;

use super::brute_force::assert_same;
use crate::common::Rng;
use crate::common::meshes::{single, soup};

fn random_rays(test: u64, count: u64) -> impl Iterator<Item = Ray> {
    (0..count).map(move |trial| {
        let mut rng = Rng::new(test, trial);
        Ray::new(rng.point(2.0), rng.direction())
    })
}

/// Caught: the tree's first node taken for granted.
#[test]
fn nothing_is_hit_in_nothing() {
    for meshes in [vec![], vec![TriangleMesh::default()], vec![TriangleMesh::default(); 3]] {
        let accel = Accel::build(&meshes);
        assert!(
            random_rays(830, 1000)
                .all(|ray| !accel.intersect1(&ray).is_hit() && !accel.occluded1(&ray))
        );
        assert_eq!((accel.triangle_count(), accel.depth()), (0, 0));
        assert!(accel.bounds().is_empty());
    }
}

/// Triangles without area cannot be hit, not even by rays at their corners. Caught: those with a normal of
/// zero kept.
#[test]
fn triangles_without_area_are_not_hit() {
    for trial in 0..20_000 {
        let mut rng = Rng::new(831, trial);
        let [a, b] = [rng.point(4.0), rng.point(4.0)];
        let corners = match rng.below(3) {
            0 => [a, a, a],
            1 => [a, b, a],
            // Exactly collinear: multiples of a short vector by small whole numbers.
            _ => {
                let step = (rng.point(1.0) * 64.0).round();
                [step, 3.0 * step, 7.0 * step]
            }
        };
        let accel = Accel::build(&[single(corners)]);
        assert_eq!(accel.triangle_count(), 0, "trial {trial}: {corners:?}");
        for corner in corners {
            let o = rng.point(2.0);
            let ray = Ray::new(o, corner - o);
            assert!(!accel.intersect1(&ray).is_hit(), "trial {trial}: {corners:?}, {ray:?}");
        }
    }
}

/// One triangle is a tree too. Caught: its box left empty.
#[test]
fn one_triangle_is_hit() {
    for trial in 0..20_000 {
        let mut rng = Rng::new(832, trial);
        let corners = [(); 3].map(|()| rng.point(3.0));
        let accel = Accel::build(&[single(corners)]);
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let normal = single(corners).geometric_normal(0);
        let ray = Ray::new(centre + normal * centre.length(), -normal);
        assert_same(&accel, &[single(corners)], &ray, &format!("trial {trial}"));
    }
}

/// Many triangles in one place: every split is as bad as any other. The first of them is the one that is
/// hit. Caught: ties broken by the order of the tree; triangles given to obvhs one by one, which takes
/// minutes for 50,000 and would take half a day for a million.
#[test]
fn triangles_in_one_place() {
    let corners = [Vec3::new(1.0, 0.0, 2.0), Vec3::new(0.0, 1.0, 2.0), Vec3::new(-1.0, -1.0, 2.0)];
    for count in [2, 3, 16, 17, 1000, 1_000_000] {
        let accel = Accel::build(&[single([Vec3::ONE; 3]), soup(&vec![corners; count])]);
        let hit = accel.intersect1(&Ray::new(Vec3::ZERO, Vec3::Z));
        assert_eq!((hit.t, hit.shape, hit.triangle), (2.0, 1, 0), "{count}");
        assert!(!accel.intersect1(&Ray::new(Vec3::ZERO, Vec3::NEG_Z)).is_hit(), "{count}");
    }
}

/// Sizes and places in geometric progression make deep trees: each level holds one triangle and all of
/// the rest. Caught: no limit to the depth, so that
/// the stack is overrun.
#[test]
fn deep_trees_are_walked() {
    let triangle = |size: f32, place: f32| {
        let at = |x: f32, y: f32| Vec3::new(place + size * x, size * y, -place);
        [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)]
    };
    let powers = |range: std::ops::Range<i32>, repeat: i32| {
        range.flat_map(move |e| {
            (0..repeat).map(move |r| (e as f32 + r as f32 / repeat as f32).exp2())
        })
    };
    let mut deepest = 0;
    for (number, triangles) in [
        powers(-60..60, 1).map(|s| triangle(s, 0.0)).collect::<Vec<_>>(),
        powers(-60..60, 1).map(|s| triangle(s, s)).collect(),
        powers(-20..20, 50).map(|s| triangle(s, -2.0 * s)).collect(),
        powers(-60..60, 20).map(|s| triangle(1e-3 * s, s)).collect(),
    ]
    .into_iter()
    .enumerate()
    {
        let meshes = [soup(&triangles)];
        let accel = Accel::build(&meshes);
        deepest = deepest.max(accel.depth());
        for trial in 0..300 {
            let mut rng = Rng::new(833 + number as u64, trial);
            let corners = triangles[rng.below(triangles.len())];
            let [b0, b1, b2] = rng.barycentric();
            let target = b0 * corners[0] + b1 * corners[1] + b2 * corners[2];
            let o =
                target + rng.direction() * 10.0_f32.powf(4.0 * rng.f32() - 2.0) * target.length();
            let ray = Ray::new(o, target - o);
            assert_same(&accel, &meshes, &ray, &format!("progression {number}, trial {trial}"));
        }
    }
    // Deeper than where the tree stops to be the cheapest, and never too deep for the stack.
    assert!((10..=16).contains(&deepest), "the deepest tree has {deepest} levels");
}

/// Rays that are none hit nothing, and end. Caught: comparisons turned round in the triangle
/// test, so that a t of NaN passes.
#[test]
fn rays_that_are_none() {
    let accel = Accel::build(&[crate::common::meshes::lumpy(3, 4)]);
    let bad = [0.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN_POSITIVE];
    for x in bad {
        for y in bad {
            for z in bad {
                let v = Vec3::new(x, y, z);
                for ray in [Ray::new(v, Vec3::Z), Ray::new(Vec3::ZERO, v), Ray::new(v, v)] {
                    let hit = accel.intersect1(&ray);
                    assert!(!hit.is_hit() || hit.t.is_finite(), "{ray:?}: {hit:?}");
                }
            }
        }
    }
    let nan_range = Ray { t_min: f32::NAN, ..Ray::new(Vec3::ZERO, Vec3::Z) };
    assert!(!accel.intersect1(&nan_range).is_hit());
}

/// Directions of any length give the same hits. Caught: a bound on the error of t in units that
/// suit directions of unit length alone.
#[test]
fn directions_of_any_length() {
    let accel = Accel::build(&[crate::common::meshes::lumpy(3, 4)]);
    for trial in 0..50_000 {
        let mut rng = Rng::new(838, trial);
        let (o, d) = (2.0 * rng.direction(), rng.direction());
        let reference = accel.intersect1(&Ray::new(o, d));
        for exponent in [-100, -60, 60, 100] {
            let scale = (exponent as f32).exp2();
            let hit = accel.intersect1(&Ray::new(o, d * scale));
            assert_eq!(hit.triangle, reference.triangle, "trial {trial}, 2^{exponent}");
            assert!(!hit.is_hit() || hit.t == reference.t / scale, "trial {trial}, 2^{exponent}");
        }
    }
}
