//! Trigonometry in shading coordinates, where the normal is the z axis.
//!
//! For a unit vector w with spherical coordinates (θ, φ): w = (sin θ cos φ, sin θ sin φ, cos θ), so
//! every function here is read off its components (PBRT 3rd edition, section 8.0.1). sin² θ is taken
//! as x² + y², which unlike 1 - z² keeps its digits close to the normal.
//!
//! Where φ is undefined, at the poles, it is taken to be 0.

use glam::Vec3;

/// cos θ, negative below the surface.
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
    // Squares this small lose digits, and then vanish.
    if sin2 > 1e-30 { sin2.sqrt() } else { w.x.hypot(w.y) }
}

/// tan θ, negative below the surface and infinite along it.
#[inline]
pub fn tan_theta(w: Vec3) -> f32 {
    sin_theta(w) / cos_theta(w)
}

/// tan² θ, infinite along the surface.
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

/// cos of the angle Δφ between two directions seen from above: with z set to zero in both, the
/// cosine that their dot product gives. 1 when one of them is the pole.
#[inline]
pub fn cos_d_phi(wa: Vec3, wb: Vec3) -> f32 {
    // The roots are taken apart: the product of two squares can underflow.
    let lengths = sin_theta(wa) * sin_theta(wb);
    if lengths == 0.0 { 1.0 } else { ((wa.x * wb.x + wa.y * wb.y) / lengths).clamp(-1.0, 1.0) }
}

/// Whether both directions lie on the same side of the surface. A direction along the surface is
/// on neither side.
#[inline]
pub fn same_hemisphere(wa: Vec3, wb: Vec3) -> bool {
    // Signs are compared, not multiplied: two tiny cosines have a product of zero.
    (wa.z > 0.0 && wb.z > 0.0) || (wa.z < 0.0 && wb.z < 0.0)
}
