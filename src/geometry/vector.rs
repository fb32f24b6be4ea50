//! Vectors of any length.

use glam::Vec3;

/// `v` at unit length; `None` when it has no direction: zero, infinite or not a number.
///
/// The square of a length leaves the range of f32 for lengths below 1e-19 and above 1e19, and loses
/// digits on the way: such vectors are scaled first.
#[inline]
pub fn unit(v: Vec3) -> Option<Vec3> {
    let length2 = v.length_squared();
    if length2 > 1e-30 && length2 < 1e30 {
        return Some(v / length2.sqrt());
    }
    let largest = v.abs().max_element();
    if !v.is_finite() || largest == 0.0 {
        return None;
    }
    let v = v / largest;
    Some(v / v.length())
}

/// The unit vector along `a` × `b`; `None` when they do not span a plane. Their lengths do not matter.
#[inline]
pub fn unit_cross(a: Vec3, b: Vec3) -> Option<Vec3> {
    unit(unit(a)?.cross(unit(b)?))
}
