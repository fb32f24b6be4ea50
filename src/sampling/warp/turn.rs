//! [`turn`]: the azimuth of a point, for the inverses of warps.

use std::f32::consts::TAU;

use crate::geometry::float::ONE_MINUS_EPSILON;

/// The azimuth of (x, y) as a fraction of a full turn, in `[0, 1)`.
pub fn turn(x: f32, y: f32) -> f32 {
    let share = y.atan2(x) / TAU;
    let turn = if share < 0.0 { share + 1.0 } else { share };
    turn.min(ONE_MINUS_EPSILON)
}
