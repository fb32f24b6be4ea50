//! The four legs.

use glam::{DVec3, DVec4};

use super::{feet, key};
use crate::scales::Skin;
use crate::sculpture::{Join, Sculpture};
use crate::tube::{Muscle, Tube};

/// A leg: its curve from inside the body to the ankle, and where its foot points (degrees about y,
/// 0 being -x, positive towards -z).
struct Leg {
    keys: [DVec4; 6],
    foot: DVec3,
    heading: f64,
    elbow: f64,
}

/// All legs with their feet.
pub fn legs(s: &mut Sculpture) {
    let legs = [
        // Front, near side.
        Leg {
            keys: [
                key(-0.86, 1.04, 0.16, 0.22),
                key(-0.74, 0.84, -0.06, 0.235),
                key(-0.55, 0.61, -0.18, 0.185),
                key(-0.66, 0.41, -0.25, 0.155),
                key(-0.88, 0.27, -0.29, 0.122),
                key(-1.04, 0.14, -0.31, 0.085),
            ],
            foot: DVec3::new(-1.08, 0.0, -0.32),
            heading: 16.0,
            elbow: 2.2,
        },
        // Front, far side: a step ahead.
        Leg {
            keys: [
                key(-0.92, 1.04, 0.50, 0.22),
                key(-0.92, 0.84, 0.66, 0.225),
                key(-0.84, 0.60, 0.74, 0.18),
                key(-1.00, 0.42, 0.74, 0.155),
                key(-1.24, 0.30, 0.70, 0.122),
                key(-1.42, 0.15, 0.67, 0.085),
            ],
            foot: DVec3::new(-1.46, 0.0, 0.66),
            heading: 4.0,
            elbow: 2.2,
        },
        // Hind, near side.
        Leg {
            keys: [
                key(1.06, 0.94, -0.26, 0.26),
                key(0.90, 0.78, -0.42, 0.265),
                key(0.71, 0.60, -0.50, 0.215),
                key(0.72, 0.41, -0.55, 0.155),
                key(0.92, 0.28, -0.59, 0.115),
                key(0.86, 0.12, -0.62, 0.085),
            ],
            foot: DVec3::new(0.80, 0.0, -0.62),
            heading: 12.0,
            elbow: 4.0,
        },
        // Hind, far side.
        Leg {
            keys: [
                key(1.10, 0.94, -0.02, 0.25),
                key(1.02, 0.78, 0.18, 0.26),
                key(0.89, 0.60, 0.32, 0.21),
                key(0.92, 0.41, 0.38, 0.155),
                key(1.12, 0.28, 0.41, 0.115),
                key(1.08, 0.12, 0.43, 0.085),
            ],
            foot: DVec3::new(1.02, 0.0, 0.43),
            heading: -14.0,
            elbow: 4.0,
        },
    ];
    for leg in &legs {
        grow(s, leg);
    }
}

fn grow(s: &mut Sculpture, leg: &Leg) {
    let muscles = [Muscle { at: 3.5, along: 1.2, angle: 0.0, around: 1.2, height: 0.15 }];
    let tube = Tube::new(&leg.keys)
        .skin(Skin::Scales { around: 10, depth: 0.24, belly: 0.0 }, (0.4, 0.7))
        .muscles(&muscles);
    let elbow = tube.station(leg.elbow);
    s.group(Join::Add, 0.13, 0.0);
    s.tube(tube);
    // Spurs behind the joint.
    s.group(Join::Add, 0.03, 0.0);
    for (lift, size) in [(-0.05, 0.8), (0.03, 1.0), (0.11, 0.75)] {
        let root = elbow.centre + DVec3::new(0.6 * elbow.radius, lift, 0.0);
        let tip = root + DVec3::new(0.22, 0.10 + 0.4 * lift, 0.0) * size;
        let middle = root.lerp(tip, 0.55) - DVec3::Y * 0.025;
        s.bone(&[root.extend(0.045 * size), middle.extend(0.03 * size), tip.extend(0.006)]);
    }
    feet::foot(s, leg.keys[5], leg.foot, leg.heading.to_radians());
}
