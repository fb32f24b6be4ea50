//! Feet: a pad, four toes with arched knuckles ahead and one behind, and a hooked claw on each.

use glam::{DMat3, DVec3, DVec4, Vec4Swizzles};

use crate::sculpture::{Join, Sculpture};
use crate::tube::Tube;

/// Angles of the toes from the foot's heading, in degrees, and their lengths.
const TOES: [(f64, f64); 5] =
    [(-46.0, 0.86), (-16.0, 1.0), (15.0, 1.0), (45.0, 0.86), (172.0, 0.62)];

/// A foot below `ankle` that stands at `place` and points to `heading` (radians about y, 0 being
/// -x, positive towards -z).
pub fn foot(s: &mut Sculpture, ankle: DVec4, place: DVec3, heading: f64) {
    let direction = |turn: f64| DVec3::new(-(heading + turn).cos(), 0.0, -(heading + turn).sin());
    let forward = direction(0.0);
    let frame = DMat3::from_cols(forward, DVec3::Y, forward.cross(DVec3::Y));
    let pad = place + forward * 0.05 + DVec3::Y * 0.085;
    s.group(Join::Add, 0.06, 0.045);
    s.ellipsoid(pad, frame, DVec3::new(0.15, 0.08, 0.125));
    s.cone(ankle.xyz(), ankle.w, pad + forward * 0.04, 0.075);
    let mut claws = Vec::new();
    for (turn, length) in TOES {
        let d = direction(turn.to_radians());
        let at = |out: f64, up: f64, r: f64| (place + d * (out * length) + DVec3::Y * up).extend(r);
        s.bone(&[
            at(0.06, 0.085, 0.055),
            at(0.18, 0.118, 0.056),
            at(0.27, 0.085, 0.05),
            at(0.33, 0.05, 0.046),
        ]);
        claws.push([
            at(0.30, 0.075, 0.036),
            at(0.40, 0.082, 0.031),
            at(0.48, 0.052, 0.018),
            at(0.525, 0.008, 0.004),
        ]);
    }
    s.group(Join::Add, 0.012, 0.0);
    for claw in claws {
        s.tube(Tube::new(&claw));
    }
}
