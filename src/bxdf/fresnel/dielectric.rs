//! Boundaries between media that do not absorb.

use crate::simd::Float;

/// The fraction of unpolarized light that a smooth boundary of dielectrics reflects; the rest is refracted.
///
/// `cos` is the cosine of the angle to the normal, of either sign, and `eta` the index of refraction on the far side, over that on
/// the side of the light: above 0. 1 on total internal reflection; 0 if `eta` is 1.
///
/// ```
/// use lobe::bxdf::fresnel::dielectric;
/// // Glass from above: ((1.5 - 1) / (1.5 + 1))².
/// assert!((dielectric(1.0, 1.5) - 0.04).abs() < 1e-7);
/// // From within, beyond the critical angle of 41.8 degrees.
/// assert_eq!(dielectric(0.7, 1.0 / 1.5), 1.0);
/// ```
#[inline]
pub fn dielectric(cos: f32, eta: f32) -> f32 {
    boundary(cos, eta)[0]
}

/// [`dielectric`] in each lane, and the cosine of the refracted direction: 0 on total internal reflection.
///
/// With c = |cos θ| and g² = η² - 1 + c², which is (η cos θt)², the amplitudes are (g - c) / (g + c) across the plane of incidence,
/// and that times (c (g + c) - 1) / (c (g - c) + 1) in it (Cook and Torrance 1982, appendix). g - c is (η² - 1) / (g + c), so
/// that nothing cancels for indices near 1.
#[inline(always)]
pub(crate) fn boundary<F: Float>(cos: F, eta: F) -> [F; 2] {
    let (zero, one) = (F::splat(0.0), F::splat(1.0));
    let c = cos.abs();
    let step = (eta - one) * (eta + one);
    let g2 = step + c * c;
    let g = g2.max(zero).sqrt();
    let sum = g + c;
    let across = step / (sum * sum);
    let ratio = (c * sum - one) / (c * (g - c) + one);
    let reflected = (F::splat(0.5) * across * across * (one + ratio * ratio)).min(one);
    let is_same = eta.eq(one);
    let is_total = g2.le(zero);
    let reflected = F::select(is_same, zero, F::select(is_total, one, reflected));
    [reflected, F::select(is_same, c, g / eta)]
}
