//! The tree gives what a loop over all triangles gives, bit by bit.

use lobe::TriangleMesh;
use lobe::accel::Accel;
use lobe::glam::Vec3;

use super::answers::{Loop, assert_answers};
use super::kinds::{Kind, many};
use crate::common::Rng;
use crate::common::meshes::{grid, lumpy, placed, soup};

/// Around the widths that hardware has, where lanes stay empty, and well beyond.
const SIZES: [usize; 13] = [1, 2, 3, 7, 8, 9, 15, 16, 17, 33, 100, 1000, 20_000];

/// Fails unless tree and loop agree on rays of every kind, about `tests` ray-triangle tests for each.
fn assert_scene(meshes: &[TriangleMesh], test: u64, tests: usize, most: usize, what: &str) {
    let (accel, truth) = (Accel::build(meshes), Loop::new(meshes));
    let count = (tests / accel.triangle_count()).clamp(50, most);
    for kind in Kind::ALL {
        let rays = many(kind, meshes, test, count);
        assert_answers(&accel, &truth, &rays, &format!("{what}, {kind:?}"));
    }
}

/// Triangles of very different sizes, `count` with an area, dealt to several shapes. Every tenth is one
/// that was there before, with its corners as they were or turned round. Among the shapes is an empty
/// one, and in each stands a triangle without area.
fn mixture(count: usize, coordinates: f64, rng: &mut Rng) -> Vec<TriangleMesh> {
    let mut all: Vec<[Vec3; 3]> = Vec::with_capacity(count);
    while all.len() < count {
        let triangle = if rng.below(10) == 0 && !all.is_empty() {
            let mut again = all[rng.below(all.len())];
            again.rotate_left(rng.below(3));
            again
        } else if coordinates > 1.0 {
            [(); 3].map(|()| rng.point(coordinates))
        } else {
            let (at, size) = (rng.point(coordinates), rng.coordinate(coordinates).abs());
            [(); 3].map(|()| at + size * rng.direction())
        };
        if lobe::shape::triangle_normal(triangle) != Vec3::ZERO {
            all.push(triangle);
        }
    }
    let mut shapes = vec![vec![[all[0][0]; 3]]; 1 + rng.below(4)];
    for triangle in all {
        let shape = rng.below(shapes.len());
        shapes[shape].push(triangle);
    }
    let mut meshes: Vec<TriangleMesh> = shapes.iter().map(|shape| soup(shape)).collect();
    meshes.insert(rng.below(meshes.len() + 1), TriangleMesh::default());
    meshes
}

fn scenes_of_all_sizes(test: u64, tests: usize, most: usize) {
    for (number, count) in SIZES.into_iter().enumerate() {
        // Small trees have few shapes: several of each.
        let trials = if count <= 33 { 8 } else { 1 };
        for trial in 0..trials {
            let mut rng = Rng::new(test, 100 * number as u64 + trial);
            let meshes = mixture(count, 1.0, &mut rng);
            let what = format!("{count} triangles, scene {trial}");
            let seed = test + 100 * number as u64 + trial;
            assert_scene(&meshes, seed, tests / trials as usize, most / trials as usize, &what);
        }
    }
}

#[test]
fn trees_of_all_sizes_give_what_a_loop_gives() {
    scenes_of_all_sizes(10_000, 6_000_000, 3000);
}

/// As above, ten times as many rays.
#[test]
#[ignore = "takes half a minute"]
fn trees_of_all_sizes_give_what_a_loop_gives_in_full() {
    scenes_of_all_sizes(20_000, 60_000_000, 30_000);
}

/// Surfaces as scenes have them: a closed mesh twice, in the same place; a grid in a plane of the axes beside
/// a lump.
fn surfaces(test: u64, tests: usize) {
    let lump = lumpy(3, 5);
    let twice = [lump.clone(), TriangleMesh::default(), lump.clone()];
    assert_scene(&twice, test, tests, tests, "a lump twice");
    let beside = [grid(8), placed(lump, 0.5, Vec3::new(0.0, 2.0, 0.0))];
    assert_scene(&beside, test + 1, tests, tests, "a grid beside a lump");
}

#[test]
fn surfaces_give_what_a_loop_gives() {
    surfaces(30_000, 4_000_000);
}

/// As above, ten times as many rays.
#[test]
#[ignore = "takes half a minute"]
fn surfaces_give_what_a_loop_gives_in_full() {
    surfaces(30_100, 40_000_000);
}

/// Sizes from 1e-8 to 1e8, each alone and all in one scene, some about the origin and some beside it.
#[test]
fn scenes_at_extreme_scales_give_what_a_loop_gives() {
    let scales = [1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6, 1e8];
    let mut all = Vec::new();
    for (number, scale) in scales.into_iter().enumerate() {
        let place = scale * Vec3::new(3.0, -5.0, 7.0);
        let meshes = [placed(lumpy(1, 6), scale, Vec3::ZERO), placed(lumpy(1, 7), scale, place)];
        assert_scene(&meshes, 31_000 + number as u64, 200_000, 4000, &format!("scale {scale}"));
        all.extend(meshes);
    }
    assert_scene(&all, 31_100, 2_000_000, 4000, "all scales");
}

/// Coordinates 10^U(-8, 8): almost all triangles are needles or shards of three lengths that have nothing to do
/// with each other.
#[test]
fn wild_coordinates_give_what_a_loop_gives() {
    for (number, count) in [1, 2, 8, 17, 300].into_iter().enumerate() {
        for trial in 0..if count < 100 { 40 } else { 4 } {
            let mut rng = Rng::new(32_000 + number as u64, trial);
            let meshes = mixture(count, 8.0, &mut rng);
            let what = format!("{count} triangles, scene {trial}");
            assert_scene(&meshes, 32_100 + 50 * number as u64 + trial, 500_000, 100, &what);
        }
    }
}
