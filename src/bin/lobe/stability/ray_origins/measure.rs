//! Counting failures at one place.
//!
//! **Trials** ([`super::scene`]): a triangle of random shape, and the three that continue it beyond its edges,
//! exactly in its plane. A ray hits one of the four, and another leaves the hit to a random side along `w`; half of
//! the directions are laid towards the surface, down to a sine of 1e-6. The coordinates are within twice the scale
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
use super::scene::Patch;
use super::triangle_test::TESTS;

/// Directions closer to the surface, as a sine, are on neither side of it: about what rounding may
/// do to a direction and to a normal.
const GRAZING: f64 = 1e-6;

/// How far away a contact is, relative to the scale.
const GAP: f64 = 1e-3;

/// Where trials are made.
#[derive(Clone, Copy, PartialEq)]
pub struct Place {
    /// The scene's coordinates are within twice this of its centre.
    pub scale: f64,
    /// From the origin to the centre.
    pub distance: f64,
}

/// What is counted.
#[derive(Clone, Copy, PartialEq)]
pub enum Failure {
    /// A ray that hits the surface that it leaves.
    SelfHit,
    /// A ray that misses what is close to it.
    LostContact,
}

/// How many rays fail with each method and each of [`TESTS`], of `rays` whose truth is beyond doubt.
///
/// Drawing ends after eight times as many: where a gap, or the triangle itself, is mostly lost in rounding, there
/// is no count.
pub fn measure(failure: Failure, place: Place, rays: u32) -> Option<[[u32; 2]; 4]> {
    let mut counts = [[0; 2]; 4];
    let mut trials = 0;
    let mut rng = Rng::new(place.scale.to_bits() ^ place.distance.to_bits().rotate_left(32));
    for _ in 0..8 * u64::from(rays) {
        if trials == rays {
            return Some(counts);
        }
        trial(&mut rng, failure, place, |failed| {
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

/// One ray. Tells `count`, if the truth is beyond doubt, which methods fail.
fn trial(rng: &mut Rng, failure: Failure, place: Place, mut count: impl FnMut(Failed)) {
    let Some(patch) = Patch::draw(rng, place) else { return };
    let Some(si) = patch.draw_hit(rng, place.scale) else { return };
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
            let Some(plate) = patch.plate(n, GAP * place.scale) else { return };
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

/// A unit direction on the side of `n`: half of them uniform, half laid towards the surface by up to 2⁻²⁰.
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
