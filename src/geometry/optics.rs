//! Where a mirror and a smooth boundary send a ray.

use glam::Vec3;

/// The direction into which a mirror with unit normal `n` reflects `wo`; both point away from the mirror.
///
/// wr = -wo + 2 (wo · n) n: the part along the normal stays, the part across it turns round
/// (PBRT 3rd edition, section 8.2.1). `n` may point to either side.
#[inline]
pub fn reflect(wo: Vec3, n: Vec3) -> Vec3 {
    2.0 * wo.dot(n) * n - wo
}

/// The direction into which a smooth boundary refracts light that comes from `wi`, or `None` when all
/// of it is reflected (total internal reflection).
///
/// `wi` and the result are unit vectors that point away from the surface, `n` is the unit normal on
/// the side of `wi`, and `eta` is the index of refraction on that side over the one beyond.
///
/// Snell's law, eta sin θi = sin θt, scales the part of the direction across the normal
/// (PBRT 3rd edition, section 8.2.3). sin θi is the length of that part, and not √(1 - cos²),
/// so that directions close to the normal keep their digits.
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
