//! The sweep over scales and distances, and the counting of failures.

use lobe::glam::{DVec3, Vec3};

use crate::method::Method;
use crate::rng::Rng;
use crate::scene::Patch;
use crate::triangle_test::TESTS;

/// Directions closer to the surface, as a sine, are on neither side of it: about what rounding may
/// do to a direction and to a normal.
const GRAZING: f64 = 1e-6;

/// Scales of the scene, in scene units.
#[rustfmt::skip]
const SCALES: [f64; 25] = [
    1e-6, 3e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 3e-1, 1e0, 3e0,
    1e1, 3e1, 1e2, 3e2, 1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6,
];

/// Distances of its centre from the origin.
#[rustfmt::skip]
const DISTANCES: [f64; 14] =
    [0.0, 1e0, 3e0, 1e1, 3e1, 1e2, 3e2, 1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6];

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
    SelfHit,
    /// A contact at this gap, relative to the scale.
    LostContact(f64),
}

impl Failure {
    pub const ALL: [Self; 3] = [Self::SelfHit, Self::LostContact(1e-3), Self::LostContact(1e-5)];
}

/// A method's failures at one place.
pub struct Row {
    pub failure: Failure,
    pub place: Place,
    pub method: Method,
    /// Rays whose truth is beyond doubt.
    pub trials: u32,
    /// How many of them fail, with each of [`TESTS`].
    pub failures: [u32; 2],
}

/// All places of the sweep: each scale at the origin, scale 1 at each distance, and between them whole
/// powers of ten of both.
pub fn places() -> Vec<Place> {
    let mut places = Vec::new();
    for (i, scale) in SCALES.into_iter().enumerate() {
        for (j, distance) in DISTANCES.into_iter().enumerate() {
            let powers_of_ten = i % 2 == 0 && j % 2 == 1;
            if distance == 0.0 || scale == 1.0 || powers_of_ten {
                places.push(Place { scale, distance });
            }
        }
    }
    places
}

/// Counts the failures of each kind and method in `rays` trials.
///
/// One ray serves for all kinds for which its truth is beyond doubt. Drawing ends after eight times as
/// many: where a gap, or the triangle itself, is mostly lost in rounding, there is no row for it.
pub fn measure(place: Place, rays: u32) -> Vec<Row> {
    let mut rows: Vec<Row> = Failure::ALL
        .into_iter()
        .flat_map(|failure| {
            Method::ALL.map(|method| Row { failure, place, method, trials: 0, failures: [0; 2] })
        })
        .collect();
    let mut rng = Rng::new(place.scale.to_bits() ^ place.distance.to_bits().rotate_left(32));
    for _ in 0..8 * u64::from(rays) {
        if rows.iter().all(|row| row.trials == rays) {
            break;
        }
        trial(&mut rng, place, |failure, failed| {
            for row in rows.iter_mut().filter(|r| r.failure == failure && r.trials < rays) {
                row.trials += 1;
                for (failures, failed) in row.failures.iter_mut().zip(failed(row.method)) {
                    *failures += u32::from(failed);
                }
            }
        });
    }
    rows.retain(|row| row.trials == rays);
    rows
}

/// Whether a method fails, with each of [`TESTS`].
type Failed<'a> = &'a dyn Fn(Method) -> [bool; 2];

/// One ray. Tells `count`, for each kind of failure of which the truth is beyond doubt, which methods fail.
fn trial(rng: &mut Rng, place: Place, mut count: impl FnMut(Failure, Failed)) {
    let Some(patch) = Patch::draw(rng, place) else { return };
    let Some(si) = patch.draw_hit(rng, place.scale) else { return };
    let n = if rng.bits() >> 63 == 0 { patch.n } else { -patch.n };
    let w = draw_leaving(rng, n);
    if w.as_dvec3().dot(n) < GRAZING {
        return;
    }
    count(Failure::SelfHit, &|method| {
        let ray = method.spawn(&si, w);
        TESTS.map(|test| patch.is_hit(test, &ray))
    });

    for failure in Failure::ALL {
        let Failure::LostContact(gap) = failure else { continue };
        let Some(plate) = patch.plate(n, gap * place.scale) else { continue };
        let o = patch.exact(si.p());
        if plate.is_truly_hit(o, w.as_dvec3()) && plate.is_truly_hit(o, n) {
            count(failure, &|method| {
                let ray = method.spawn(&si, w);
                TESTS.map(|test| !plate.is_hit(test, &ray))
            });
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
