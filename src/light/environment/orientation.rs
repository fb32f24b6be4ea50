//! [`Orientation`]: which direction of the world each point of an equirectangular image stands for.

use std::f64::consts::PI;

use glam::{DMat3, DQuat, DVec3, Quat, Vec3};

use crate::params::Handedness;
use crate::simd::Float;

/// A point of the image, and its direction's height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// From 0 at the left to 1 at the right.
    pub x: f64,
    /// From 0 at the top to 1 at the bottom: θ / π.
    pub y: f64,
    /// cos θ, from 1 at the top to -1 at the bottom. Not of y, which has lost digits at the poles.
    pub z: f64,
}

/// How the image lies in the world: as an equirectangular camera sees it that looks along +z with +y up.
#[derive(Clone, Debug)]
pub struct Orientation {
    /// Right, up and forward in the world.
    axes: DMat3,
}

impl Orientation {
    /// The image turned with the world by `rotation`. `None` if that is no rotation.
    pub fn new(rotation: Quat, handedness: Handedness) -> Option<Self> {
        let rotation = DQuat::from_array(rotation.to_array().map(f64::from));
        let is_rotation = (rotation.length_squared() - 1.0).abs() < 1e-3;
        let right = match handedness {
            Handedness::Left => DVec3::X,
            Handedness::Right => DVec3::NEG_X,
        };
        let rotation = DMat3::from_quat(rotation.normalize());
        let axes = DMat3::from_cols(right, DVec3::Y, DVec3::Z);
        is_rotation.then_some(Self { axes: rotation * axes })
    }

    /// The point of the image for a direction, which need not be of unit length.
    #[inline]
    pub fn place(&self, w: Vec3) -> Place {
        let [right, up, forward] = (self.axes.transpose() * w.as_dvec3()).to_array();
        let across2 = right * right + forward * forward;
        let (across, length) = (across2.sqrt(), (across2 + up * up).sqrt());
        // 1 - |cos θ| as sin² θ / (1 + |cos θ|), since w was rounded.
        let below_pole = across2 / (length * (length + up.abs()));
        Place {
            x: 0.5 + angle(right, forward, across) / (2.0 * PI),
            y: angle(across, up, length) / PI,
            z: (1.0 - below_pole).copysign(up),
        }
    }

    /// The unit vector for a column, as [`Place::x`], and a height.
    #[inline]
    pub fn direction(&self, x: f64, z: f64) -> Vec3 {
        let [cos, sin] = Float::unit_circle(x);
        let across = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
        // φ = 2π (x - 1/2): half a turn away.
        let local = DVec3::new(-sin * across, z, -cos * across);
        (self.axes * local).normalize().as_vec3()
    }
}

/// The angle from (1, 0) to (x, y), whose length is given, in radians, in `[-π, π]`; 0 for (0, 0). Absolute error 1e-10; the
/// same bits on every platform, unlike the system's. [`Float::atan2`] has an error of 3e-7, a thousandth of a column of a large
/// image.
#[inline]
fn angle(y: f64, x: f64, length: f64) -> f64 {
    let (across, along) = (x.abs(), y.abs());
    let is_steep = along > across;
    let (low, high) = if is_steep { (across, along) } else { (along, across) };
    if high == 0.0 {
        return 0.0;
    }
    // tan(φ/2) = sin φ / (1 + cos φ), of an eighth of a turn at most.
    let t = low / (high + length);
    // The series of the arctangent, t - t³/3 + t⁵/5 ..., as two of every other term, which do not wait for each other.
    let (t2, t4) = (t * t, t * t * (t * t));
    let series =
        |first: i32| (0..6).rev().fold(0.0, |sum, i| 1.0 / f64::from(4 * i + first) + t4 * sum);
    let angle = 2.0 * t * (series(1) - t2 * series(3));
    let angle = if is_steep { 0.5 * PI - angle } else { angle };
    let angle = if x < 0.0 { PI - angle } else { angle };
    angle.copysign(y)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the system's.
    #[test]
    fn angles_are_those_of_the_system() {
        for i in 0..10_000 {
            let turn = f64::from(i) / 10_000.0 * 2.0 * PI - PI;
            let (y, x) = turn.sin_cos();
            let off = (angle(1e-3 * y, 1e-3 * x, 1e-3) - y.atan2(x)).abs();
            assert!(off < 1e-10, "{turn}: off by {off}");
        }
        assert_eq!(angle(0.0, 0.0, 0.0), 0.0);
    }
}
