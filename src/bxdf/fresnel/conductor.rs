//! Metals.

use glam::{Vec3, Vec4};

use crate::simd::Float;
use crate::spectrum::{Bands, Spectrum};

/// The fraction of unpolarized light that a smooth metal reflects, per band.
///
/// `cos` is the cosine of the angle to the normal, of either sign. `eta` + i `k` is the complex index of refraction over that of the
/// medium outside.
///
/// ```
/// use lobe::Spectrum;
/// use lobe::bxdf::fresnel::conductor;
/// // Without absorption it is a dielectric.
/// let f = conductor(1.0, Spectrum::splat(1.5), Spectrum::BLACK).to_array();
/// assert!((f[0] - 0.04).abs() < 1e-7);
/// ```
#[inline]
pub fn conductor(cos: f32, eta: Spectrum, k: Spectrum) -> Spectrum {
    let bands = |s: Spectrum| Vec3::from(s.to_array()).extend(0.0);
    let [r, g, b, _] = of_band(Vec4::splat(cos), bands(eta), bands(k)).to_array();
    Spectrum::new(r, g, b)
}

/// [`conductor`] in each lane.
#[inline(always)]
pub fn of_conductor<F: Float>(cos: F, eta: [f32; 3], k: [f32; 3]) -> Bands<F> {
    let mut bands = [F::splat(0.0); 3];
    for ((band, eta), k) in bands.iter_mut().zip(eta).zip(k) {
        *band = of_band(cos, F::splat(eta), F::splat(k));
    }
    Bands(bands)
}

/// A band.
///
/// With a + ib = √(η² - k² - sin² θ + 2iηk) and c = cos θ, |r|² is ((a - c)² + b²) / ((a + c)² + b²) across the plane of incidence, and that
/// times ((ac - s²)² + b²c²) / ((ac + s²)² + b²c²) with s = sin θ in it (PBRT 3rd edition, section 8.2.1). The smaller of a and b is
/// ηk over the larger one: its square would be a small difference of large numbers.
#[inline(always)]
fn of_band<F: Float>(cos: F, eta: F, k: F) -> F {
    let (zero, half, one) = (F::splat(0.0), F::splat(0.5), F::splat(1.0));
    let c = cos.abs().min(one);
    let sin2 = (one - c) * (one + c);
    // η² - 1 + c² is η² - sin² θ.
    let (real, imaginary) = ((eta - one) * (eta + one) - k * k + c * c, eta * k);
    let modulus = (real * real + F::splat(4.0) * imaginary * imaginary).sqrt();
    let larger = (half * (modulus + real.abs())).sqrt();
    let smaller = F::select(larger.gt(zero), imaginary / larger, zero);
    let is_positive = real.ge(zero);
    let a = F::select(is_positive, larger, smaller);
    let b = F::select(is_positive, smaller, larger);
    let square = |x: F| x * x;
    let across = (square(a - c) + b * b, square(a + c) + b * b);
    let along = (square(a * c - sin2) + square(b * c), square(a * c + sin2) + square(b * c));
    // 0/0 where nothing refracts: across the plane if there is no boundary, in it if the index is 0.
    let ratio = |(above, below): (F, F), none: F| F::select(below.gt(zero), above / below, none);
    let across = ratio(across, zero);
    half * across * (one + ratio(along, one))
}
