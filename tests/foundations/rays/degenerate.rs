//! Degenerate meshes: no panic, and no wrong hit.

use lobe::TriangleMesh;
use lobe::accel::{Accel, Hit};
use lobe::geometry::Ray;
use lobe::glam::Vec3;
use lobe::shape::MeshError;

use super::answers::{Loop, assert_answers, assert_single};
use crate::common::Rng;
use crate::common::meshes::{lumpy, single, soup};

/// Triangles without area: points, lines, and corners exactly in a row.
fn without_area(rng: &mut Rng) -> [Vec3; 3] {
    let [a, b] = [rng.point(4.0), rng.point(4.0)];
    match rng.below(5) {
        0 => [a, a, a],
        1 => [a, b, a],
        2 => [a, a, b],
        3 => [b, a, a],
        // Multiples of a short vector by small whole numbers.
        _ => {
            let step = (rng.point(1.0) * 64.0).round();
            [step, 3.0 * step, 7.0 * step]
        }
    }
}

/// Caught: the tree's first node taken for granted; the second half of a batch left as it was.
#[test]
fn empty_scenes_have_no_hits() {
    for meshes in [vec![], vec![TriangleMesh::default()], vec![TriangleMesh::default(); 3]] {
        let accel = Accel::build(&meshes);
        let rays: Vec<Ray> = (0..1000)
            .map(|trial| {
                let mut rng = Rng::new(830, trial);
                Ray::new(rng.point(2.0), rng.direction())
            })
            .collect();
        assert_answers(&accel, &Loop::new(&meshes), &rays, "nothing");
        assert!(!accel.intersect1(&rays[0]).is_hit());
        assert_eq!((accel.triangle_count(), accel.depth()), (0, 0));
        assert!(accel.bounds().is_empty());
    }
}

/// Triangles without area cannot be hit, not even by rays at their corners. Caught: such triangles kept.
#[test]
fn triangles_without_area_are_not_hit() {
    for trial in 0..20_000 {
        let mut rng = Rng::new(831, trial);
        let corners = without_area(&mut rng);
        let accel = Accel::build(&[single(corners)]);
        assert_eq!(accel.triangle_count(), 0, "trial {trial}: {corners:?}");
        for corner in corners {
            let o = rng.point(2.0);
            let what = format!("trial {trial}: {corners:?}");
            assert_single(&accel, &Ray::new(o, corner - o), &Hit::MISS, &what);
        }
    }
}

/// Nor do they change what is hit beside them, or in front of what they lie. Caught: eight rays walked in the
/// octant of the first; answers put in the wrong places.
#[test]
fn triangles_without_area_change_nothing() {
    let mut rng = Rng::new(834, 0);
    let bad: Vec<[Vec3; 3]> = (0..5000).map(|_| without_area(&mut rng)).collect();
    let clean = [TriangleMesh::default(), lumpy(3, 2)];
    let accel = Accel::build(&[soup(&bad), lumpy(3, 2), soup(&bad)]);
    let rays: Vec<Ray> = (0..2000)
        .map(|trial| {
            let mut rng = Rng::new(835, trial);
            let o = 3.0 * rng.direction();
            let at =
                if trial % 2 == 0 { bad[rng.below(bad.len())][0] } else { 0.5 * rng.direction() };
            Ray::new(o, at - o)
        })
        .collect();
    assert_answers(&accel, &Loop::new(&clean), &rays, "beside triangles without area");
}

/// One triangle is a tree too, of whatever shape: coordinates are 10^U(-8, 8). Caught: the box of a tree of
/// one leaf left empty; -0 taken for forwards.
#[test]
fn one_triangle_is_hit() {
    let mut hit = 0;
    for trial in 0..50_000 {
        let mut rng = Rng::new(832, trial);
        let corners = [(); 3].map(|()| rng.point(8.0));
        let meshes = [single(corners)];
        let accel = Accel::build(&meshes);
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let normal = meshes[0].geometric_normal(0);
        let o = rng.point(8.0);
        let rays = [
            Ray::new(centre + normal * centre.length(), -normal),
            Ray::new(o, centre - o),
            Ray::new(o, corners[rng.below(3)] - o),
            Ray::new(o, rng.point(8.0)),
        ];
        assert_answers(&accel, &Loop::new(&meshes), &rays, &format!("triangle {trial}"));
        hit += u32::from(accel.intersect1(&rays[0]).is_hit());
    }
    assert!(hit > 10_000, "only {hit} triangles were hit from above");
}

/// Vertices that the tree cannot store are refused: NaN, infinities and numbers that are too large, in any coordinate of
/// any vertex. Caught: NaN let through; numbers too far out let through.
#[test]
fn invalid_vertices_are_refused() {
    let bad = [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1.001e12, f32::MIN];
    for trial in 0..1000 {
        let mut rng = Rng::new(836, trial);
        let mut mesh = lumpy(2, trial);
        assert_eq!(mesh.check(), Ok(()));
        let vertex = rng.below(mesh.positions.len());
        mesh.positions[vertex][rng.below(3)] = bad[rng.below(bad.len())];
        let refused =
            matches!(mesh.check(), Err(MeshError::Position { vertex: v, .. }) if v == vertex);
        assert!(refused, "trial {trial}: {:?}: {:?}", mesh.positions[vertex], mesh.check());
    }
}
