//! Trigonometric functions of directions in shading coordinates, where the normal is the z axis.
//!
//! A unit vector w with spherical coordinates (θ, φ) is w = (sin θ cos φ, sin θ sin φ, cos θ), so
//! each function follows from its components (PBRT 3rd edition, section 8.0.1). sin² θ is computed
//! as x² + y², which unlike 1 - z² keeps its precision near the normal.
//!
//! At the poles φ is undefined; it is taken to be 0.

use glam::Vec3;

use crate::simd::Float;

/// cos θ; negative below the surface.
#[inline]
pub fn cos_theta(w: Vec3) -> f32 {
    w.z
}

/// cos² θ.
#[inline]
pub fn cos2_theta(w: Vec3) -> f32 {
    w.z * w.z
}

/// |cos θ|.
#[inline]
pub fn abs_cos_theta(w: Vec3) -> f32 {
    w.z.abs()
}

/// sin² θ.
#[inline]
pub fn sin2_theta(w: Vec3) -> f32 {
    w.x * w.x + w.y * w.y
}

/// sin θ, never negative.
#[inline]
pub fn sin_theta(w: Vec3) -> f32 {
    let sin2 = sin2_theta(w);
    // Squares below about 1e-30 lose digits or underflow to zero.
    if sin2 > 1e-30 { sin2.sqrt() } else { w.x.hypot(w.y) }
}

/// tan θ; negative below the surface, infinite at the horizon.
#[inline]
pub fn tan_theta(w: Vec3) -> f32 {
    sin_theta(w) / cos_theta(w)
}

/// tan² θ; infinite at the horizon.
#[inline]
pub fn tan2_theta(w: Vec3) -> f32 {
    sin2_theta(w) / cos2_theta(w)
}

/// cos φ.
#[inline]
pub fn cos_phi(w: Vec3) -> f32 {
    let sin_theta = sin_theta(w);
    if sin_theta == 0.0 { 1.0 } else { (w.x / sin_theta).clamp(-1.0, 1.0) }
}

/// sin φ.
#[inline]
pub fn sin_phi(w: Vec3) -> f32 {
    let sin_theta = sin_theta(w);
    if sin_theta == 0.0 { 0.0 } else { (w.y / sin_theta).clamp(-1.0, 1.0) }
}

/// cos² φ.
#[inline]
pub fn cos2_phi(w: Vec3) -> f32 {
    cos_phi(w) * cos_phi(w)
}

/// sin² φ.
#[inline]
pub fn sin2_phi(w: Vec3) -> f32 {
    sin_phi(w) * sin_phi(w)
}

/// cos Δφ, the cosine of the difference in azimuth of two directions: that of the angle between
/// their projections onto the surface. 1 if either is a pole.
#[inline]
pub fn cos_d_phi(wa: Vec3, wb: Vec3) -> f32 {
    // A product of two roots, not the root of a product: the product of the squares can underflow.
    let lengths = sin_theta(wa) * sin_theta(wb);
    if lengths == 0.0 { 1.0 } else { ((wa.x * wb.x + wa.y * wb.y) / lengths).clamp(-1.0, 1.0) }
}

/// Whether both directions lie on the same side of the surface. A direction at the horizon, z = 0,
/// is on neither side.
#[inline]
pub fn same_hemisphere(wa: Vec3, wb: Vec3) -> bool {
    same_side(wa.z, wb.z)
}

/// Whether two cosines are both above 0 or both below.
#[inline(always)]
pub(crate) fn same_side<F: Float>(a: F, b: F) -> F::Mask {
    let zero = F::splat(0.0);
    // Signs are compared, because the product of two tiny cosines underflows to zero.
    (a.gt(zero) & b.gt(zero)) | (a.lt(zero) & b.lt(zero))
}
