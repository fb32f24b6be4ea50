//! Hair: the mane behind the jaw, the beard, and two long whiskers.

use crate::sculpture::{Join, Sculpture};
use crate::tube::Tube;

use super::head::{SIDES, Skull};

/// Builds the hair.
pub fn mane(s: &mut Sculpture, skull: &Skull) {
    s.group(Join::Add, 0.03, 0.0);
    for m in SIDES {
        locks(s, skull, m);
    }
    beard(s, skull);
    s.group(Join::Add, 0.015, 0.0);
    for m in SIDES {
        let whisker = [
            [0.66, 0.05, 0.13, 0.026],
            [0.71, 0.02, 0.25, 0.022],
            [0.57, 0.02, 0.34, 0.019],
            [0.34, 0.05, 0.39, 0.017],
            [0.12, -0.03, 0.43, 0.014],
            [-0.08, -0.01, 0.48, 0.010],
            [-0.26, -0.10, 0.50, 0.006],
        ];
        s.bone(&skull.keys(&whisker, m));
    }
}

/// Locks that fan out from the cheek: (root up, length, tip up, tip aside).
fn locks(s: &mut Sculpture, skull: &Skull, m: f64) {
    const LOCKS: [[f64; 4]; 8] = [
        [0.12, 0.42, 0.26, 0.30],
        [0.06, 0.50, 0.08, 0.36],
        [0.00, 0.54, -0.10, 0.38],
        [-0.07, 0.52, -0.26, 0.36],
        [-0.13, 0.46, -0.42, 0.32],
        [-0.18, 0.36, -0.52, 0.26],
        [0.09, 0.30, 0.18, 0.40],
        [-0.04, 0.34, -0.16, 0.44],
    ];
    for [up, length, tip_up, tip_side] in LOCKS {
        let mid = 0.5 * (up + tip_up);
        let keys = [
            [-0.02, up, 0.17, 0.055],
            [-0.05 - 0.3 * length, 0.6 * up + 0.4 * mid - 0.03, 0.24, 0.055],
            [-0.05 - 0.7 * length, 0.3 * mid + 0.7 * tip_up - 0.02, 0.10 + 0.55 * tip_side, 0.035],
            [-0.05 - length, tip_up + 0.06, tip_side, 0.006],
        ];
        s.tube(Tube::new(&skull.keys(&keys, m)).side(skull.side()).oval(0.6));
    }
}

fn beard(s: &mut Sculpture, skull: &Skull) {
    const TUFTS: [[f64; 3]; 5] = [
        [0.50, 0.0, 0.30],
        [0.42, 0.06, 0.24],
        [0.42, -0.06, 0.24],
        [0.30, 0.09, 0.18],
        [0.30, -0.09, 0.18],
    ];
    for [f, side, length] in TUFTS {
        let u = -0.14 - 0.50 * f - 0.05;
        let keys = [
            [f, u, side, 0.04],
            [f - 0.03, u - 0.45 * length, side * 1.1, 0.03],
            [f - 0.14, u - length, side * 1.2, 0.005],
        ];
        s.bone(&skull.keys(&keys, 1.0));
    }
}
