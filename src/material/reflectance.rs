//! [`reflectance`]: fractions of light, as textures give them.

use crate::spectrum::Spectrum;

/// The fraction clamped to `[0, 1]` per band; `None` if it is black. Values that are not finite are kept: the Bsdf counts them.
#[inline]
pub fn reflectance(fraction: Spectrum) -> Option<Spectrum> {
    let r = if fraction.is_finite() { fraction.clamp(0.0, 1.0) } else { fraction };
    (!r.is_black()).then_some(r)
}
