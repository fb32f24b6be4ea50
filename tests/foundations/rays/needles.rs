//! Triangles whose coordinates are 10^U(-8, 8): almost all are needles, or have three edges of very different
//! lengths.

use lobe::accel::{Accel, Hit};
use lobe::geometry::Ray;

use super::answers::{Loop, ask, bits};
use super::kinds::{Kind, many};
use crate::common::Rng;
use crate::common::meshes::mixture;

/// Fails unless `hit` is one that traversal may find. There is a hit if the loop has one, and the hit has the bits that
/// its triangle gives alone.
///
/// It need not be the loop's hit. Along a needle the error of t may exceed the padding of any box, up to t itself
/// (the triangle test rejects a t below its error bound). Traversal that has a hit closer than the box of such a
/// needle skips the box, and is right: the needle is not closer, its t is too small by mistake. So t has to be less
/// than twice the loop's.
fn assert_possible(truth: &Loop, ray: &Ray, hit: &Hit, what: &str) {
    let closest = truth.closest(ray);
    assert_eq!(hit.is_hit(), closest.is_hit(), "{what}: {ray:?}: {hit:?}, expected {closest:?}");
    let again = truth.again(ray, hit);
    assert_eq!(bits(hit), bits(&again), "{what}: {ray:?}: {hit:?}, by itself {again:?}");
    let near = !hit.is_hit() || closest.t <= hit.t && hit.t <= 2.0 * closest.t;
    assert!(near, "{what}: {ray:?}: {hit:?}, expected {closest:?}");
}

fn needles(test: u64, trials: u64, count: usize) {
    let mut hits = 0;
    for (number, triangles) in [1, 2, 3, 8, 9, 17, 300].into_iter().enumerate() {
        for trial in 0..trials {
            let seed = test + trials * number as u64 + trial;
            let meshes = mixture(triangles, 8.0, &mut Rng::new(seed, 0));
            let (accel, truth) = (Accel::build(&meshes), Loop::new(&meshes));
            for kind in Kind::ALL {
                let what = format!("{triangles} triangles, scene {trial}, {kind:?}");
                // Infinite rays: at the end of a range, the error of t would matter too.
                let whole = |ray: Ray| Ray::new(ray.o, ray.d);
                let rays: Vec<Ray> =
                    many(kind, &meshes, seed, count).into_iter().map(whole).collect();
                let (found, occluded) = ask(&accel, &rays);
                for (i, ray) in rays.iter().enumerate() {
                    let what = format!("{what}, trial {i}");
                    let single = accel.intersect1(ray);
                    assert_possible(&truth, ray, &single, &what);
                    assert_possible(&truth, ray, &found[i], &format!("{what}, in a batch"));
                    let any = [accel.occluded1(ray), occluded[i]];
                    assert_eq!(any, [single.is_hit(); 2], "{what}: {ray:?}: any hit");
                    hits += u32::from(single.is_hit());
                }
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
