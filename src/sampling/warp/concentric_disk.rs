//! The unit disk, uniformly, with squares around the centre taken to circles.
//!
//! Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square": on (a, b) = 2u - 1, the
//! larger of |a| and |b| is the radius, and their ratio runs through an eighth of a turn. Neighbours
//! stay neighbours, so that stratified samples stay stratified.

use std::f32::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4};

use glam::Vec2;

/// A point of the unit disk.
#[inline]
pub fn sample(u: Vec2) -> Vec2 {
    let (r, phi) = polar(u);
    r * Vec2::from_angle(phi)
}

/// The signed radius and the angle of the point that [`sample`] gives. The radius is exact for any
/// u on the grid of floats that samplers give, and 1 only at the border of the square.
#[inline]
pub(super) fn polar(u: Vec2) -> (f32, f32) {
    let square = 2.0 * u - Vec2::ONE;
    if square.x.abs() > square.y.abs() {
        (square.x, FRAC_PI_4 * (square.y / square.x))
    } else if square.y != 0.0 {
        (square.y, FRAC_PI_2 - FRAC_PI_4 * (square.x / square.y))
    } else {
        (0.0, 0.0)
    }
}

/// Density over area, 1/π everywhere on the disk.
#[inline]
pub fn pdf() -> f32 {
    FRAC_1_PI
}

/// The u that [`sample`] takes to `p`.
#[inline]
pub fn inverse(p: Vec2) -> Vec2 {
    let r = p.length();
    let square = if p.x.abs() > p.y.abs() {
        let a = r.copysign(p.x);
        Vec2::new(a, a * (p.y / p.x).atan() / FRAC_PI_4)
    } else if p.y != 0.0 {
        let b = r.copysign(p.y);
        Vec2::new(b * (p.x / p.y).atan() / FRAC_PI_4, b)
    } else {
        Vec2::ZERO
    };
    (square + Vec2::ONE) / 2.0
}
