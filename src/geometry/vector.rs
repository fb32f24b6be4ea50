//! Normalisation of vectors of any length.

use glam::Vec3;

use super::xyz::Xyz;
use crate::simd::Float;

/// `v` scaled to unit length. `None` if `v` is zero or not finite.
///
/// The squared length of vectors shorter than 1e-19 or longer than 1e19 under- or overflows f32,
/// and loses precision before that. Such vectors are scaled before they are normalised.
#[inline]
pub fn unit(v: Vec3) -> Option<Vec3> {
    let (scaled, is_precise) = unit_wide(Xyz::from(v));
    if is_precise {
        return Some(scaled.into());
    }
    let largest = v.abs().max_element();
    if !v.is_finite() || largest == 0.0 {
        return None;
    }
    let v = v / largest;
    Some(v / v.length())
}

/// `v` scaled to unit length, and where that is precise without scaling it first.
#[inline(always)]
pub fn unit_wide<F: Float>(v: Xyz<F>) -> (Xyz<F>, F::Mask) {
    let length2 = v.length_squared();
    let is_precise = length2.gt(F::splat(1e-30)) & length2.lt(F::splat(1e30));
    (v / length2.sqrt(), is_precise)
}

/// The unit vector along `a` × `b`, for vectors of any length. `None` if they are parallel, zero or
/// not finite.
#[inline]
pub fn unit_cross(a: Vec3, b: Vec3) -> Option<Vec3> {
    unit(unit(a)?.cross(unit(b)?))
}
