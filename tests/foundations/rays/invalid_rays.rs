//! Invalid rays, and rays of unusual lengths.

use lobe::accel::{Accel, Hit};
use lobe::geometry::Ray;
use lobe::glam::Vec3;

use super::answers::{Loop, assert_answers};
use super::kinds;
use crate::common::Rng;
use crate::common::meshes::{lumpy, soup};

/// Zeros, infinities and NaN as origin, direction and range: traversal ends, and gives the same as a loop, which is
/// never a hit at a distance that is not finite. Caught: a t of NaN taken for a hit; eight rays that all
/// miss when one of them is NaN.
#[test]
fn invalid_rays() {
    for levels in [0, 1, 3] {
        let meshes = [lumpy(levels, 4)];
        let (accel, truth) = (Accel::build(&meshes), Loop::new(&meshes));
        let rays = kinds::none();
        assert_answers(&accel, &truth, &rays, &format!("{levels} levels"));
        for ray in &rays {
            let hit = accel.intersect1(ray);
            assert!(!hit.is_hit() || hit.t.is_finite(), "{ray:?}: {hit:?}");
        }
    }
}

/// The longest and the shortest directions, for which t is out of the range of f32: traversal ends, and
/// any hit is a triangle. Caught: a box entered whatever NaN says, and a t of NaN taken for a hit.
#[test]
fn directions_at_the_ends_of_floats() {
    let accel = Accel::build(&[lumpy(3, 4)]);
    let ends = [0.0, f32::MAX, f32::MIN, f32::MIN_POSITIVE, 1e-45, -1e-45];
    for d in ends.iter().flat_map(|&x| ends.map(|y| ends.map(|z| Vec3::new(x, y, z)))).flatten() {
        for o in [Vec3::ZERO, 3.0 * Vec3::X, Vec3::splat(1e12), Vec3::splat(f32::MAX)] {
            let rays = [Ray::new(o, d); 9];
            let mut hits = [Hit::MISS; 9];
            let mut occluded = [false; 9];
            accel.intersect(&rays, &mut hits);
            accel.occluded(&rays, &mut occluded);
            hits[8] = accel.intersect1(&rays[0]);
            accel.occluded1(&rays[0]);
            let sound = |hit: &Hit| !hit.is_hit() || hit.t >= 0.0 && hit.triangle < 512;
            assert!(hits.iter().all(sound), "{o}, {d}: {hits:?}");
        }
    }
}

/// Directions of any length give the same hits. Caught: a bound on the error of t in units that suit
/// directions of unit length alone.
#[test]
fn directions_of_any_length() {
    let accel = Accel::build(&[lumpy(3, 4)]);
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

/// Rays shorter than the smallest normal number, in batches as alone. Caught: the length of a beam inverted,
/// which overflows.
#[test]
fn rays_as_short_as_floats_go() {
    let corners = [Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, -1.0, 0.0), Vec3::Y];
    let accel = Accel::build(&[soup(&[corners])]);
    for (trial, tiny) in [1e-45, 1e-40, 1e-39, 1e-38, 1e-37].into_iter().enumerate() {
        let ray = |i: usize| Ray {
            t_max: 2.0 * tiny,
            ..Ray::new(Vec3::new(0.01 * (i / 2) as f32, 0.0, -tiny), Vec3::Z)
        };
        let rays: Vec<Ray> = (0..64).map(ray).collect();
        let mut hits = vec![Hit::MISS; rays.len()];
        accel.intersect(&rays, &mut hits);
        for (i, hit) in hits.iter().enumerate() {
            assert_eq!(*hit, accel.intersect1(&rays[i]), "trial {trial}, ray {i}");
        }
    }
}

/// Long directions in small scenes and short ones in large scenes: t is right even if it is as small as
/// 1e-26 or as large as 1e30. Caught: z scaled to be t before it is multiplied with the edge functions.
#[test]
fn directions_of_any_length_in_scenes_of_any_size() {
    for (trial, size) in [1e-8, 1e-4, 1.0, 1e4, 1e8, 1e12].into_iter().enumerate() {
        let corners = [Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 0.0, -1.0), Vec3::Z];
        let accel = Accel::build(&[soup(&[corners.map(|corner| size * corner)])]);
        for length in [1e-18, 1e-9, 1.0, 1e9, 1e18] {
            let ray = Ray::new(0.75 * size * Vec3::Y, -length * Vec3::Y);
            let expected = 0.75 * f64::from(size) / f64::from(length);
            let hits = [accel.intersect1(&ray), {
                let mut hits = [Hit::MISS; 16];
                accel.intersect(&[ray; 16], &mut hits);
                hits[15]
            }];
            for hit in hits {
                let error = (f64::from(hit.t) / expected - 1.0).abs();
                assert!(error < 1e-6, "trial {trial}, length {length}: {hit:?}, not {expected}");
            }
        }
    }
}

/// A direction with NaN hits nothing, alone and in a batch, and the valid rays of the batch still hit.
/// Caught: as above; eight rays walked in the octant of the first; zero taken for backwards, whose quotients
/// are NaN.
#[test]
fn one_bad_ray_spoils_no_batch() {
    let accel = Accel::build(&[lumpy(3, 4)]);
    // Beams of rays that are all but the same, forwards and backwards.
    for (place, z) in (0..64).flat_map(|place| [(place, 1.0), (place, -1.0)]) {
        for bad in [Vec3::ZERO, -Vec3::ZERO, Vec3::NAN, Vec3::X * f32::NAN, 1e-45 * Vec3::Z] {
            let ray = |i: usize| Ray::new(Vec3::ZERO, Vec3::new(0.1, 0.2 + 1e-3 * i as f32, z));
            let mut rays: Vec<Ray> = (0..128).map(ray).collect();
            rays[place].d = bad;
            let mut hits = vec![Hit::MISS; rays.len()];
            accel.intersect(&rays, &mut hits);
            for (i, hit) in hits.iter().enumerate().filter(|&(i, _)| i != place) {
                assert_eq!(*hit, accel.intersect1(&rays[i]), "{bad} at {place}, ray {i}");
            }
        }
    }
    for place in 0..40 {
        for bad in [Vec3::ZERO, Vec3::NAN, Vec3::X * f32::NAN, Vec3::INFINITY, -Vec3::ZERO] {
            let mut rays = vec![Ray::new(Vec3::ZERO, Vec3::new(0.1, 0.2, 1.0)); 40];
            rays[place].d = bad;
            let mut hits = vec![Hit::MISS; 40];
            let mut occluded = vec![false; 40];
            accel.intersect(&rays, &mut hits);
            accel.occluded(&rays, &mut occluded);
            for i in 0..40 {
                assert_eq!((hits[i].is_hit(), occluded[i]), (i != place, i != place), "{bad}, {i}");
            }
        }
    }
}
