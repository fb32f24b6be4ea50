//! The open mouth: lower jaw, teeth and tongue.

use crate::sculpture::{Join, Sculpture};
use crate::tube::Tube;

use super::head::{SIDES, Skull};

/// How far the jaw hangs open, in radians.
const OPEN: f64 = 0.62;
/// Hinge of the jaw: ahead and up.
const HINGE: [f64; 2] = [0.02, -0.12];

/// Builds the mouth.
pub fn mouth(s: &mut Sculpture, skull: &Skull) {
    jaw(s, skull);
    teeth(s, skull);
    tongue(s, skull);
}

/// A key in the frame of the jaw: ahead of its hinge, up and aside, with a radius.
fn hang(k: [f64; 4]) -> [f64; 4] {
    let (sin, cos) = OPEN.sin_cos();
    [HINGE[0] + k[0] * cos + k[1] * sin, HINGE[1] - k[0] * sin + k[1] * cos, k[2], k[3]]
}

fn jaw(s: &mut Sculpture, skull: &Skull) {
    s.group(Join::Add, 0.05, 0.05);
    for m in SIDES {
        let branch = [
            [-0.04, 0.0, 0.15, 0.085],
            [0.16, -0.03, 0.13, 0.07],
            [0.38, -0.03, 0.10, 0.055],
            [0.56, 0.0, 0.065, 0.05],
        ];
        s.bone(&skull.keys(&branch.map(hang), m));
    }
    let floor = [
        [0.0, -0.06, 0.0, 0.09],
        [0.25, -0.07, 0.0, 0.075],
        [0.45, -0.055, 0.0, 0.065],
        [0.61, 0.0, 0.0, 0.06],
    ];
    s.bone(&skull.keys(&floor.map(hang), 1.0));
}

fn teeth(s: &mut Sculpture, skull: &Skull) {
    s.group(Join::Add, 0.012, 0.0);
    for m in SIDES {
        for i in 0..7 {
            let t = f64::from(i) / 6.0;
            let fang = if i == 5 { 1.9 } else { 1.0 };
            let f = 0.24 + 0.46 * t;
            let (u, side) = (-0.10 + 0.03 * t + 0.075 * t * t, 0.148 - 0.045 * t);
            let long = (0.085 + 0.02 * t) * fang;
            let tooth = [
                [f, u + 0.02, side, 0.03],
                [f + 0.006, u - 0.4 * long, side, 0.022],
                [f - 0.018, u - long, side * 0.95, 0.004],
            ];
            s.bone(&skull.keys(&tooth, m));
        }
        // Incisors under the nose.
        for (f, side) in [(0.755, 0.07), (0.775, 0.025)] {
            let tooth = [
                [f, 0.02, side, 0.026],
                [f + 0.006, -0.03, side, 0.019],
                [f - 0.01, -0.075, side, 0.004],
            ];
            s.bone(&skull.keys(&tooth, m));
        }
        for i in 0..6 {
            let t = f64::from(i) / 5.0;
            let fang = if i == 5 { 1.9 } else { 1.0 };
            let f = 0.20 + 0.38 * t;
            let side = 0.125 - 0.065 * t;
            let long = (0.07 + 0.01 * t) * fang;
            let tooth = [
                [f, 0.02, side, 0.024],
                [f, 0.045 + 0.4 * long, side, 0.018],
                [f - 0.02, 0.04 + long, side * 1.02, 0.004],
            ];
            s.bone(&skull.keys(&tooth.map(hang), m));
        }
    }
}

fn tongue(s: &mut Sculpture, skull: &Skull) {
    s.group(Join::Add, 0.03, 0.0);
    let keys = [
        [0.04, 0.0, 0.0, 0.05],
        [0.20, 0.035, 0.0, 0.048],
        [0.35, 0.075, 0.0, 0.043],
        [0.46, 0.14, 0.0, 0.036],
        [0.52, 0.22, 0.0, 0.027],
        [0.585, 0.275, 0.0, 0.012],
    ];
    let tongue = Tube::new(&skull.keys(&keys.map(hang), 1.0));
    s.tube(tongue.side(skull.side()).oval(1.45));
}
