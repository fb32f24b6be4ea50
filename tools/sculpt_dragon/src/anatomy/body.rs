//! Neck, trunk and tail in one curve, and the crest of spikes along its back.

use std::f64::consts::PI;

use glam::DVec3;

use super::key;
use crate::scales::Skin;
use crate::tube::{Muscle, Tube};

/// The body, from the skull to the tip of the tail.
pub fn spine() -> Tube {
    let keys = [
        key(-1.34, 2.36, 0.10, 0.20),
        key(-1.04, 2.24, 0.17, 0.215),
        key(-0.83, 1.96, 0.24, 0.235),
        key(-0.83, 1.60, 0.30, 0.28),
        key(-0.93, 1.22, 0.34, 0.35),
        key(-0.82, 0.88, 0.34, 0.39),
        key(-0.44, 0.84, 0.28, 0.37),
        key(-0.10, 1.12, 0.20, 0.34),
        key(0.20, 1.44, 0.10, 0.32),
        key(0.58, 1.50, 0.00, 0.315),
        key(0.86, 1.22, -0.10, 0.335),
        key(1.04, 0.86, -0.20, 0.345),
        key(1.32, 0.58, -0.30, 0.275),
        key(1.62, 0.52, -0.42, 0.215),
        key(1.85, 0.78, -0.52, 0.175),
        key(1.82, 1.16, -0.60, 0.145),
        key(1.62, 1.44, -0.65, 0.12),
        key(1.50, 1.76, -0.68, 0.10),
        key(1.60, 2.04, -0.70, 0.08),
        key(1.74, 2.18, -0.71, 0.05),
    ];
    let muscles = [
        // Breast.
        Muscle { at: 4.6, along: 1.2, angle: PI, around: 1.0, height: 0.10 },
        // Shoulder blades.
        Muscle { at: 5.3, along: 1.0, angle: 1.3, around: 0.9, height: 0.12 },
        Muscle { at: 5.3, along: 1.0, angle: -1.3, around: 0.9, height: 0.12 },
        // Haunches.
        Muscle { at: 11.0, along: 1.1, angle: 1.3, around: 0.9, height: 0.12 },
        Muscle { at: 11.0, along: 1.1, angle: -1.3, around: 0.9, height: 0.12 },
    ];
    Tube::new(&keys)
        .skin(Skin::Scales { around: 18, depth: 0.24, belly: 0.62 }, (0.8, 4.5))
        .oval(0.92)
        .muscles(&muscles)
}

/// Spikes along the back, pointing up and tailwards.
pub fn crest(spine: &Tube) -> Vec<Tube> {
    let mut spikes = Vec::new();
    let mut at = 0.9;
    while at < 17.6 {
        let s = spine.station(at);
        let height = 0.10 + 0.46 * s.radius;
        let root = s.centre + s.back * (0.93 * s.radius);
        let lean = s.tangent * 0.55;
        let base = 0.045 + 0.14 * s.radius;
        let place = |up: f64, along: f64, r: f64| {
            let p: DVec3 = root + (s.back * up + lean * along) * height;
            p.extend(r)
        };
        let keys =
            [place(-0.2, -0.2, base), place(0.45, 0.15, 0.62 * base), place(1.0, 0.95, 0.008)];
        // Flattened across the body: the long axis of the section runs along it.
        spikes.push(Tube::new(&keys).side(s.across).oval(0.45));
        at += (0.11 + 0.30 * s.radius) / spine.speed(at);
    }
    spikes
}

/// The flame at the tip of the tail: blades that fan out from its end and bend upwards.
pub fn flame(spine: &Tube) -> Vec<Tube> {
    // (keys before the end of the curve, angle towards the back, length, aside)
    const BLADES: [[f64; 4]; 9] = [
        [0.05, 0.0, 0.62, 0.0],
        [0.1, 0.35, 0.54, 0.15],
        [0.1, -0.35, 0.52, -0.15],
        [0.3, 0.65, 0.46, -0.1],
        [0.3, -0.65, 0.44, 0.1],
        [0.6, 0.8, 0.40, 0.1],
        [0.6, -0.8, 0.38, -0.1],
        [0.95, 0.85, 0.32, 0.0],
        [0.95, -0.85, 0.30, 0.0],
    ];
    let blade = |[before, turn, length, aside]: [f64; 4]| {
        let s = spine.station(spine.len() as f64 - before);
        let out = (s.tangent * turn.cos() + s.back * turn.sin() + s.across * aside).normalize();
        let place = |along: f64, lift: f64, r: f64| {
            (s.centre + (out * along + DVec3::Y * lift) * length).extend(r)
        };
        let keys = [
            place(0.0, 0.0, 0.05),
            place(0.25, -0.06, 0.075),
            place(0.55, -0.05, 0.062),
            place(0.80, 0.08, 0.034),
            place(0.98, 0.28, 0.005),
        ];
        Tube::new(&keys).side(s.across).oval(0.75)
    };
    BLADES.map(blade).into()
}
