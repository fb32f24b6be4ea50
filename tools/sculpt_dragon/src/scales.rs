//! Relief of the skin, in a tube's own coordinates: rows along the curve and angle around it.

use std::f64::consts::{PI, TAU};

/// What covers a tube.
#[derive(Clone, Copy)]
pub enum Skin {
    /// Nothing.
    Smooth,
    /// Overlapping scales in staggered rows whose free edges point along the curve.
    Scales {
        /// Scales around the whole circumference.
        around: u32,
        /// Height of a free edge, as a part of the scale's width.
        depth: f64,
        /// Half-angle of the strip of belly plates about the underside; 0 for none.
        belly: f64,
    },
    /// Growth rings, as on a horn.
    Rings {
        /// Height of a ring, as a part of the radius.
        depth: f64,
    },
}

impl Skin {
    /// Length of a row along the curve, as a part of the radius.
    pub fn row_length(self) -> f64 {
        match self {
            Skin::Smooth => 1.0,
            Skin::Scales { around, .. } => 0.82 * TAU / f64::from(around),
            Skin::Rings { .. } => 0.55,
        }
    }

    /// Height of the relief, as a part of the radius, at row coordinate `u` and angle `theta` (0
    /// at the back, pi below).
    pub fn relief(self, u: f64, theta: f64) -> f64 {
        match self {
            Skin::Smooth => 0.0,
            Skin::Scales { around, depth, belly } => {
                let width = TAU / f64::from(around);
                let below = PI - theta.abs();
                let plates = if belly > 0.0 {
                    1.0 - smoothstep(belly - 0.06, belly + 0.06, below)
                } else {
                    0.0
                };
                let mut height = 0.0;
                if plates < 1.0 {
                    height += (1.0 - plates) * scale_height(u, theta / width);
                }
                if plates > 0.0 {
                    height += plates * plate_height(u, below / belly);
                }
                depth * width * height
            }
            Skin::Rings { depth } => depth * (0.5 + 0.5 * (TAU * u).sin()),
        }
    }
}

/// Height in \[0, 1\] of a coat of scales, each one row long and one wide, at row coordinate `u`
/// and column coordinate `v`. A scale rises from its root to its free edge, which covers the roots
/// of the next two rows.
fn scale_height(u: f64, v: f64) -> f64 {
    let row = u.floor();
    let mut height: f64 = 0.0;
    for back in 0..2 {
        let i = row - f64::from(back);
        let shift = if i.rem_euclid(2.0) < 1.0 { 0.0 } else { 0.5 };
        let a = u - i;
        let b = v - shift;
        let b = b - b.round();
        height = height.max(one_scale(a, b));
        // The neighbour across the nearer side reaches under this one.
        height = height.max(one_scale(a, b - b.signum()));
    }
    height
}

/// Height of one scale at `a` from its root (its tip lies at a = 1.75) and `b` from its middle
/// line.
fn one_scale(a: f64, b: f64) -> f64 {
    const HALF_WIDTH: f64 = 0.62;
    const LENGTH: f64 = 1.75;
    let across = b / HALF_WIDTH;
    if across.abs() >= 1.0 {
        return 0.0;
    }
    let tip = LENGTH * (1.0 - across * across).sqrt();
    let edge = smoothstep(0.0, 0.28, tip - a);
    let slope = 0.25 * smoothstep(0.0, 0.3, a) + 0.75 * (a / LENGTH);
    let crown = 1.0 - 0.3 * across * across;
    edge * slope * crown
}

/// Height of belly plates at row coordinate `u`; `side` runs from 0 on the middle line to 1 at the
/// ends of a plate.
fn plate_height(u: f64, side: f64) -> f64 {
    let a = (0.7 * u + 0.08 * side * side).rem_euclid(1.0);
    let edge = smoothstep(0.0, 0.2, 1.0 - a);
    let end = 1.0 - smoothstep(0.78, 1.02, side);
    1.3 * (0.3 + 0.7 * a * edge) * end
}

/// Hermite step from 0 at `low` to 1 at `high`.
pub fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
