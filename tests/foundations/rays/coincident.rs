//! Many triangles at one place, and triangles inside of triangles: trees without useful splits, and very deep
//! trees.

use lobe::TriangleMesh;
use lobe::accel::Accel;
use lobe::geometry::Ray;
use lobe::glam::Vec3;

use super::answers::{Loop, assert_answers, assert_batch};
use crate::common::Rng;
use crate::common::meshes::{lumpy, single, soup};

const CORNERS: [Vec3; 3] =
    [Vec3::new(1.0, 0.0, 2.0), Vec3::new(0.0, 1.0, 2.0), Vec3::new(-1.0, -1.0, 2.0)];

/// Rays at and past [`CORNERS`].
fn rays_at_corners(test: u64, count: u64) -> Vec<Ray> {
    (0..count)
        .map(|trial| {
            let mut rng = Rng::new(test, trial);
            let o = rng.point(1.0);
            let target = Vec3::new(rng.within(-1.0, 1.0), rng.within(-1.0, 1.0), 2.0);
            Ray::new(o, target - o)
        })
        .collect()
}

/// Many identical triangles, so that every split is equally bad. The first of them is the one
/// that is hit, with the bits that one triangle gives. Caught: the later of equals taken; a leaf cut to its
/// last 15; all but the first half of a batch left out.
#[test]
fn triangles_in_one_place() {
    let alone = [TriangleMesh::default(), single(CORNERS)];
    let truth = Loop::new(&alone);
    for count in [2, 3, 7, 8, 9, 15, 16, 17, 33, 255, 256, 257, 1000, 1_000_000] {
        let accel = Accel::build(&[single([Vec3::ONE; 3]), soup(&vec![CORNERS; count])]);
        assert_eq!(accel.triangle_count(), count);
        let rays = rays_at_corners(1400, if count > 1000 { 8 } else { 200 });
        assert_answers(&accel, &truth, &rays, &format!("{count} triangles"));
    }
}

/// The same, with the corners of each triangle rotated, and with other triangles of the same box: they differ in
/// what they hit, not in their bounds. Caught: a leaf cut to its last 15 triangles; boxes that are not
/// padded; ties broken by the order of the tree.
#[test]
fn triangles_in_one_box() {
    let [a, b, c] = CORNERS;
    let other = [Vec3::new(-1.0, 1.0, 2.0), Vec3::new(1.0, 1.0, 2.0), Vec3::new(0.0, -1.0, 2.0)];
    let kinds = [[a, b, c], [b, c, a], [c, b, a], other, [other[1], other[2], other[0]]];
    for count in [5, 16, 17, 40, 300] {
        let heap: Vec<[Vec3; 3]> = (0..count).map(|i| kinds[i * i % 7 % 5]).collect();
        let meshes = [soup(&heap), lumpy(1, 3), soup(&heap[1..])];
        let (accel, truth) = (Accel::build(&meshes), Loop::new(&meshes));
        assert_answers(&accel, &truth, &rays_at_corners(1410, 500), &format!("{count} triangles"));
    }
}

/// A million triangles without area in one point, beside one with an area. Caught: triangles without
/// area kept.
#[test]
fn triangles_in_one_point() {
    let points = soup(&vec![[Vec3::new(0.25, 0.0, 1.0); 3]; 1_000_000]);
    let accel = Accel::build(&[points, single(CORNERS)]);
    assert_eq!(accel.triangle_count(), 1);
    let truth = Loop::new(&[TriangleMesh::default(), single(CORNERS)]);
    let mut rays = rays_at_corners(1420, 200);
    rays.push(Ray::new(Vec3::ZERO, Vec3::new(0.25, 0.0, 1.0)));
    assert_answers(&accel, &truth, &rays, "a million points");
}

/// Sizes in geometric progression make deep trees: each level has one triangle and a subtree of all smaller ones, for
/// thousands of levels of binary nodes. Where the triangles are layered, a ray from
/// below enters the smaller ones first, and leaves one entry per level on the stack.
/// Caught: what waits beyond 64, and beyond 256, dropped; padding that leaves out where the ray begins.
#[test]
fn deep_trees_are_walked() {
    let triangle = |size: f32, place: f32, height: f32| {
        let at = |x: f32, y: f32| Vec3::new(place + size * x, size * y, height - place);
        [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)]
    };
    // Three corners of a square: its box is the same whichever is left out.
    let layer = |size: f32, left_out: usize| {
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let (x, y) = (|i: usize| square[i % 4].0, |i: usize| square[i % 4].1);
        [1, 2, 3].map(|i| size * Vec3::new(x(left_out + i), y(left_out + i), 0.01))
    };
    let powers = |end: f64, step: f64| {
        let count = (2.0 * end / step) as i32;
        (0..count).map(move |i| (f64::from(i) * step - end).exp2() as f32)
    };
    // Of two children each, these are 67, 3592, 708, 292, 45, 42 and 54 levels deep.
    let chains: [Vec<[Vec3; 3]>; 7] = [
        powers(36.0, 1.0).map(|s| triangle(s, 0.0, 0.0)).collect(),
        powers(36.0, 0.02).map(|s| triangle(s, 0.0, 0.0)).collect(),
        powers(36.0, 0.1).enumerate().map(|(i, s)| layer(s, i * i % 7)).collect(),
        powers(3.0, 0.02).enumerate().map(|(i, s)| layer(s, i * i % 7)).collect(),
        powers(36.0, 1.0).map(|s| triangle(s, s, 0.0)).collect(),
        powers(20.0, 0.02).map(|s| triangle(s, -2.0 * s, 0.0)).collect(),
        powers(36.0, 0.05).map(|s| triangle(1e-3 * s, s, 0.0)).collect(),
    ];
    let mut deepest = 0;
    for (number, triangles) in chains.iter().enumerate() {
        let meshes = [soup(triangles)];
        let (accel, truth) = (Accel::build(&meshes), Loop::new(&meshes));
        deepest = deepest.max(accel.depth());
        let ray = |trial: u64| {
            let mut rng = Rng::new(1430 + number as u64, trial);
            let corners = triangles[rng.below(triangles.len())];
            let [b0, b1, b2] = rng.barycentric();
            let inside = b0 * corners[0] + b1 * corners[1] + b2 * corners[2];
            let target = [inside, corners[0], corners[1]][rng.below(3)];
            let length = (corners[1] - corners[0]).length().max(target.length());
            match rng.below(3) {
                // From within most of the boxes.
                0 => Ray::new(corners[0] + rng.point(12.0), rng.direction()),
                // From below all layers.
                1 => Ray::new(inside - 2.0 * length * Vec3::Z, Vec3::Z),
                _ => {
                    let away = rng.direction() * rng.coordinate(2.0) * length;
                    Ray::new(target + away, -away)
                }
            }
        };
        let rays: Vec<Ray> = (0..1500).map(ray).collect();
        assert_answers(&accel, &truth, &rays, &format!("chain {number}"));
    }
    // Deeper than the cheapest tree would be, and never too deep for the stack.
    assert!((15..=24).contains(&deepest), "the deepest tree has {deepest} levels");
}

/// A shallow tree with one deep branch: most rays of a batch need little stack, some need much.
/// Caught: what waits beyond 64, and beyond 256, dropped; eight rays walked in the octant of the first.
#[test]
fn deep_and_shallow_rays_in_one_batch() {
    let chain: Vec<[Vec3; 3]> = (0..1500)
        .map(|i| {
            let s = 1.02_f32.powi(i - 1000);
            [Vec3::ZERO, Vec3::new(s, 0.0, 0.3 * s), Vec3::new(0.0, s, 0.3 * s)]
        })
        .collect();
    let meshes = [lumpy(4, 2), soup(&chain)];
    let (accel, truth) = (Accel::build(&meshes), Loop::new(&meshes));
    let rays: Vec<Ray> = (0..2000)
        .map(|trial| {
            let mut rng = Rng::new(1440, trial);
            let o = 2.0 * rng.direction();
            let at_chain = rng.below(4) == 0;
            Ray::new(o, if at_chain { 1e-6 * rng.direction() - o } else { rng.direction() })
        })
        .collect();
    let truths: Vec<_> = rays.iter().map(|ray| truth.closest(ray)).collect();
    let order: Vec<usize> = (0..rays.len()).collect();
    for length in [7, 8, 16, 33, 1024] {
        for batch in order.chunks(length) {
            assert_batch(&accel, &rays, batch, &truths, "a chain in a lump");
        }
    }
}
