//! The object that materials are shown on: a drop, cut below like a gem, hollow, with a pearl in it.
//!
//! Facets and a round window beside the opening are flat, so images in them keep their shape; the
//! shoulder is round. In the hollow light is reflected more than once. The curl at the top is thin.
//! It opens towards -z; y is up, and it stands on y = 0.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3, DVec4};

use crate::sculpture::{Join, Sculpture};
use crate::tube::Tube;

/// A box that holds the whole object with room to spare.
pub const LOW: DVec3 = DVec3::new(-1.4, -0.3, -1.4);
/// The other corner of the box.
pub const HIGH: DVec3 = DVec3::new(1.4, 3.2, 1.4);

/// Middle of the body, a ball of radius 1.
const MIDDLE: DVec3 = DVec3::new(0.0, 0.88, 0.0);
/// Where the hollow opens.
const OPENING: DVec3 = DVec3::new(0.40, 0.42, -0.79);

/// Normal of the round window, before it is made a unit vector, and its distance from the middle.
const WINDOW: (DVec3, f64) = (DVec3::new(-0.47, 0.40, -0.79), 0.94);

/// Rows of facets: number, elevation of the normal as a sine, distance from the middle.
const ROWS: [(u32, f64, f64); 2] = [(9, -0.28, 0.925), (9, -0.72, 0.925)];

/// Puts the object together.
pub fn object() -> Sculpture {
    let mut s = Sculpture::default();
    // As wide a blend as the neck's: `Field` drops shapes farther off than their group's widths.
    s.group(Join::Add, 0.6, 0.0);
    s.ellipsoid(MIDDLE, DMat3::IDENTITY, DVec3::ONE);
    s.group(Join::Add, 0.6, 0.0);
    s.cone(MIDDLE + 0.5 * DVec3::Y, 0.3, MIDDLE + 1.2 * DVec3::Y, 0.17);
    s.group(Join::Carve, 0.018, 0.02);
    for (normal, offset) in cuts() {
        s.beyond(normal, offset);
    }
    s.group(Join::Add, 0.15, 0.0);
    s.tube(curl());
    s.group(Join::Carve, 0.05, 0.1);
    s.cone(MIDDLE, 0.8, MIDDLE + OPENING, 0.4);
    s.cone(MIDDLE, 0.8, MIDDLE + 1.08 * DVec3::Y, 0.08);
    s.group(Join::Add, 0.08, 0.0);
    let pearl = MIDDLE + DVec3::new(0.12, -0.40, -0.30);
    s.ellipsoid(pearl, DMat3::IDENTITY, DVec3::splat(0.35));
    s
}

/// The planes that cut the body: unit normals and offsets.
fn cuts() -> impl Iterator<Item = (DVec3, f64)> {
    let facets = ROWS.into_iter().enumerate().flat_map(|(row, (count, rise, distance))| {
        (0..count).map(move |i| {
            let turn = TAU * (f64::from(i) + 0.5 * row as f64) / f64::from(count);
            let level = (1.0 - rise * rise).sqrt();
            (DVec3::new(level * turn.sin(), rise, level * turn.cos()), distance)
        })
    });
    let window = (WINDOW.0.normalize(), WINDOW.1);
    let base = (DVec3::NEG_Y, MIDDLE.y);
    facets.chain([window, base]).map(|(n, distance)| (n, n.dot(MIDDLE) + distance))
}

/// The tip: a spline from the body that winds up and thins out.
fn curl() -> Tube {
    const KEYS: [[f64; 4]; 11] = [
        [0.00, 0.95, 0.00, 0.20],
        [0.00, 1.22, 0.00, 0.175],
        [-0.08, 1.52, 0.00, 0.145],
        [-0.29, 1.75, 0.00, 0.115],
        [-0.56, 1.77, -0.01, 0.092],
        [-0.74, 1.57, -0.03, 0.075],
        [-0.68, 1.35, -0.06, 0.062],
        [-0.49, 1.30, -0.10, 0.052],
        [-0.38, 1.43, -0.13, 0.045],
        [-0.44, 1.55, -0.15, 0.040],
        [-0.54, 1.54, -0.16, 0.037],
    ];
    let keys = KEYS.map(|[x, y, z, radius]| MIDDLE.extend(0.0) + DVec4::new(x, y, z, radius));
    Tube::new(&keys)
}

/// How much a place is looked at: the curl and the edges of the facets most.
pub fn interest(p: DVec3) -> f64 {
    let on = |distance: f64| distance.abs() < 0.015;
    let faces = cuts().filter(|&(n, offset)| on(n.dot(p) - offset)).count();
    let curl = p.y > MIDDLE.y + 1.05;
    let edge = faces + usize::from(on(p.distance(MIDDLE) - 1.0)) > 1;
    if curl || edge { 6.0 } else { 1.0 }
}
