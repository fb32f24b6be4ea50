//! Triangles whose coordinates are 10^U(-8, 8): almost all are needles, or have three edges of very different
//! lengths.

use lobe::accel::Accel;

use super::answers::{Loop, assert_answers};
use super::kinds::{Kind, many};
use crate::common::Rng;
use crate::common::meshes::mixture;

fn needles(test: u64, trials: u64, count: usize) {
    let mut hits = 0;
    for (number, triangles) in [1, 2, 3, 8, 9, 17, 300].into_iter().enumerate() {
        for trial in 0..trials {
            let seed = test + trials * number as u64 + trial;
            let meshes = mixture(triangles, 8.0, &mut Rng::new(seed, 0));
            let (accel, truth) = (Accel::build(&meshes), Loop::new(&meshes));
            for kind in Kind::ALL {
                let what = format!("{triangles} triangles, scene {trial}, {kind:?}");
                let rays = many(kind, &meshes, seed, count);
                assert_answers(&accel, &truth, &rays, &what);
                hits += rays.iter().filter(|ray| accel.occluded1(ray)).count();
            }
        }
    }
    assert!(hits > 1000, "only {hits} rays hit");
}

/// Caught: boxes neither padded nor their far side moved by the rounding of the slabs; eight rays walked in
/// the octant of the first; a batch's rest left out.
#[test]
fn needles_are_hit_as_a_loop_hits_them() {
    needles(32_000, 20, 50);
}

/// As above, thirty times as many scenes.
#[test]
#[ignore = "takes half a minute"]
fn needles_are_hit_as_a_loop_hits_them_in_full() {
    needles(40_000, 600, 50);
}
