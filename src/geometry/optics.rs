//! Directions of mirror reflection and of refraction.

use glam::Vec3;

/// Mirror reflection of `wo` about the unit normal `n`. `wo` and the result both point away from
/// the surface.
///
/// wr = -wo + 2 (wo · n) n: the component along the normal is kept, the tangential one is negated
/// (PBRT 3rd edition, section 8.2.1). `n` may point to either side.
#[inline]
pub fn reflect(wo: Vec3, n: Vec3) -> Vec3 {
    2.0 * wo.dot(n) * n - wo
}

/// Refraction at a smooth boundary of light that arrives from `wi`. `None` on total internal
/// reflection.
///
/// `wi` and the result are unit vectors that point away from the surface. `n` is the unit normal on
/// the side of `wi`. `eta` is the relative index of refraction: that of `wi`'s side over that of
/// the far side.
///
/// By Snell's law, eta sin θi = sin θt, the tangential component is scaled by eta (PBRT 3rd
/// edition, section 8.2.3). sin θi is computed as the length of that component, not as √(1 - cos²
/// θi), which would lose precision near the normal.
#[inline]
pub fn refract(wi: Vec3, n: Vec3, eta: f32) -> Option<Vec3> {
    let across = wi - wi.dot(n) * n;
    let sin2_theta_t = eta * eta * across.length_squared();
    if sin2_theta_t >= 1.0 {
        return None;
    }
    let cos_theta_t = (1.0 - sin2_theta_t).sqrt();
    Some(-eta * across - cos_theta_t * n)
}
