//! The tree gives what a loop over all triangles gives, bit by bit.

use lobe::TriangleMesh;
use lobe::accel::{Accel, Hit};
use lobe::geometry::Ray;
use lobe::glam::Vec3;

use super::answers::{Loop, assert_answers, bits};
use super::kinds::{Kind, many};
use crate::common::Rng;
use crate::common::meshes::{grid, lumpy, mixture, placed, soup};

/// Around the widths of hardware vectors, where lanes stay empty, and well beyond.
const SIZES: [usize; 13] = [1, 2, 3, 7, 8, 9, 15, 16, 17, 33, 100, 1000, 20_000];

/// Fails unless tree and loop agree on rays of every kind, with about `tests` ray-triangle tests for each.
fn assert_scene(meshes: &[TriangleMesh], test: u64, tests: usize, most: usize, what: &str) {
    let (accel, truth) = (Accel::build(meshes), Loop::new(meshes));
    let count = (tests / accel.triangle_count()).clamp(50, most);
    for kind in Kind::ALL {
        let rays = many(kind, meshes, test, count);
        assert_answers(&accel, &truth, &rays, &format!("{what}, {kind:?}"));
    }
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

/// Caught: boxes that are not padded, or for the largest coordinate alone; -0 taken for forwards; t_min
/// ignored, and t_max by `occluded`; ties broken by the order of the tree; the box of a tree of one leaf left
/// empty; a batch's second half left out.
#[test]
fn trees_of_all_sizes_give_what_a_loop_gives() {
    scenes_of_all_sizes(10_000, 6_000_000, 3000);
}

/// As above, ten times as many rays.
#[test]
#[ignore = "takes a minute"]
fn trees_of_all_sizes_give_what_a_loop_gives_in_full() {
    scenes_of_all_sizes(20_000, 60_000_000, 30_000);
}

/// Typical surfaces: a closed mesh twice, in the same place; a grid in an axis-aligned plane beside
/// a closed mesh.
fn surfaces(test: u64, tests: usize) {
    let lump = lumpy(3, 5);
    let twice = [lump.clone(), TriangleMesh::default(), lump.clone()];
    assert_scene(&twice, test, tests, tests, "a lump twice");
    let beside = [grid(8), placed(lump, 0.5, Vec3::new(0.0, 2.0, 0.0))];
    assert_scene(&beside, test + 1, tests, tests, "a grid beside a lump");
}

/// Caught: the same, but for the empty box.
#[test]
fn surfaces_give_what_a_loop_gives() {
    surfaces(30_000, 4_000_000);
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
    assert_scene(&[soup(&large), soup(&small)], 847, 5_000_000, 500, "parts");
}

/// As above, ten times as many rays.
#[test]
#[ignore = "takes half a minute"]
fn surfaces_give_what_a_loop_gives_in_full() {
    surfaces(30_100, 40_000_000);
}

/// Sizes from 1e-8 to 1e8, each alone and all in one scene, some about the origin and some beside it. Caught:
/// the same, but for the empty box.
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

/// Indices of shapes and triangles are returned unchanged, however large: 70,000 shapes of a few triangles,
/// and one of 140,000. Caught: the shape cut to 16 bits; the triangle cut to 16 bits.
#[test]
fn large_indices_come_back() {
    let at = |i: usize| Vec3::new((i % 300) as f32, (i / 300) as f32, 0.0);
    let tile = |i: usize| [Vec3::ZERO, Vec3::X, Vec3::Y].map(|corner| at(i) + 0.75 * corner);
    let small = (0..70_000).map(|i| soup(&vec![tile(i); 1 + i % 2]));
    let mut meshes: Vec<TriangleMesh> = small.collect();
    let behind = (0..140_000).map(|i| tile(i).map(|corner| corner + Vec3::Z));
    meshes.push(soup(&behind.collect::<Vec<_>>()));
    let accel = Accel::build(&meshes);
    let centre = Vec3::new(0.25, 0.25, 0.0);
    let (mut rays, mut numbers) = (Vec::new(), Vec::new());
    for i in (0..140_000).step_by(7) {
        // From in front, where the small shapes end before the large one does, and from behind.
        rays.push(Ray::new(at(i) + centre - 2.0 * Vec3::Z, Vec3::Z));
        numbers.push(if i < 70_000 { (i, 0) } else { (70_000, i) });
        rays.push(Ray::new(at(i) + centre + 2.0 * Vec3::Z, Vec3::NEG_Z));
        numbers.push((70_000, i));
    }
    let mut hits = vec![Hit::MISS; rays.len()];
    accel.intersect(&rays, &mut hits);
    for (ray, (hit, (shape, triangle))) in rays.iter().zip(hits.iter().zip(numbers)) {
        assert_eq!((hit.shape as usize, hit.triangle as usize), (shape, triangle), "{ray:?}");
        assert_eq!(bits(hit), bits(&accel.intersect1(ray)), "{ray:?}");
    }
}
