//! Counts failures at one placement of the scene.
//!
//! **Trials** ([`super::scene`]): a triangle of random shape, and the three that continue it beyond its edges,
//! exactly in its plane. A ray hits one of the four, and another leaves the hit to a random side along `w`. Half of
//! the directions are flattened towards the surface, down to a sine of 1e-6. The coordinates are within twice the scale
//! of a centre at the given distance from the origin.
//!
//! **Failures**, each against a truth in f64 from the f32 numbers as they are:
//!
//! - False self-hit: the leaving ray hits one of the four triangles. The exact hit point lies in their plane and `w`
//!   leaves it, so that there is no such hit. Only directions at a sine of at least 1e-6 from the plane count: closer
//!   to it, the rounding of `w` and of the normal may decide on the side.
//! - Lost contact: a plate, parallel to the surface at a gap of 1e-3 of the scale, is not hit by the leaving ray. Only
//!   rays count for which the plate holds, with a margin, both the hit of the exact ray and the foot of the
//!   perpendicular: then the ray hits it from every start between the exact point and that foot. The gap must be at
//!   least the spacing of floats at that distance, and at the corners of the plate, rounded to f32, between half and
//!   one and a half of what it should be.

use lobe::glam::{DVec3, Vec3};

use super::super::rng::Rng;
use super::method::Method;
use super::placement::Placement;
use super::scene::Patch;
use super::triangle_test::TESTS;

/// Smallest sine between a direction and the surface. Closer to it, rounding of the direction and the normal decides on
/// the side.
const GRAZING: f64 = 1e-6;

/// Distance of a contact, relative to the scale.
const GAP: f64 = 1e-3;

/// The kind of failure to count.
#[derive(Clone, Copy, PartialEq)]
pub enum Failure {
    /// A ray hits the surface that it leaves.
    SelfHit,
    /// A ray misses a plate close to its origin.
    LostContact,
}

/// Number of failures for each method and each of [`TESTS`], among `rays` rays whose truth is certain.
///
/// `None` if eight times as many trials do not give enough such rays: where the gap, or the triangle itself, is mostly
/// below the spacing of floats.
pub fn measure(failure: Failure, placement: Placement, rays: u32) -> Option<[[u32; 2]; 4]> {
    let mut counts = [[0; 2]; 4];
    let mut trials = 0;
    let mut rng =
        Rng::new(placement.scale.to_bits() ^ placement.distance.to_bits().rotate_left(32));
    for _ in 0..8 * u64::from(rays) {
        if trials == rays {
            return Some(counts);
        }
        trial(&mut rng, failure, placement, |failed| {
            trials += 1;
            for (counts, method) in counts.iter_mut().zip(Method::ALL) {
                for (count, failed) in counts.iter_mut().zip(failed(method)) {
                    *count += u32::from(failed);
                }
            }
        });
    }
    (trials == rays).then_some(counts)
}

/// Whether a method fails, with each of [`TESTS`].
type Failed<'a> = &'a dyn Fn(Method) -> [bool; 2];

/// One ray. Calls `count` with the failures if the truth is certain.
fn trial(rng: &mut Rng, failure: Failure, placement: Placement, mut count: impl FnMut(Failed)) {
    let Some(patch) = Patch::draw(rng, placement) else { return };
    let Some(si) = patch.draw_hit(rng, placement.scale) else { return };
    let n = if rng.bits() >> 63 == 0 { patch.n } else { -patch.n };
    let w = draw_leaving(rng, n);
    if w.as_dvec3().dot(n) < GRAZING {
        return;
    }
    match failure {
        Failure::SelfHit => count(&|method| {
            let ray = method.spawn(&si, w);
            TESTS.map(|test| patch.is_hit(test, &ray))
        }),
        Failure::LostContact => {
            let Some(plate) = patch.plate(n, GAP * placement.scale) else { return };
            let o = patch.exact(si.p());
            if plate.is_truly_hit(o, w.as_dvec3()) && plate.is_truly_hit(o, n) {
                count(&|method| {
                    let ray = method.spawn(&si, w);
                    TESTS.map(|test| !plate.is_hit(test, &ray))
                });
            }
        }
    }
}

/// A unit direction on the side of `n`: half of them uniform, half flattened towards the surface by a factor down to
/// 2⁻²⁰.
fn draw_leaving(rng: &mut Rng, n: DVec3) -> Vec3 {
    let mut w = rng.direction();
    if w.dot(n) < 0.0 {
        w = -w;
    }
    if rng.bits() >> 63 == 0 {
        let flatter = 1.0 / (1_u64 << (rng.bits() % 21)) as f64;
        w -= (1.0 - flatter) * w.dot(n) * n;
    }
    w.normalize().as_vec3()
}
