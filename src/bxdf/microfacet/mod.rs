//! Rough surfaces as many small smooth ones: their distribution, and what light loses that meets more than one of them.

mod azimuths;
mod boundary_losses;
mod ggx;
mod losses;
mod multiple;
mod returned;
mod row;

pub use boundary_losses::BoundaryLosses;
pub use ggx::Ggx;
pub use losses::{Losses, Roughnesses};
pub(super) use multiple::Spread;

use crate::geometry::Xyz;
use crate::simd::Float;

/// Two directions mirrored so that the first is above the surface.
#[inline(always)]
pub(super) fn above<F: Float>([wo, wi]: [Xyz<F>; 2]) -> [Xyz<F>; 2] {
    let is_below = wo.z.lt(F::splat(0.0));
    [flipped(is_below, wo), flipped(is_below, wi)]
}

/// The direction on the other side of the surface, in lanes of a mask.
#[inline(always)]
pub(super) fn flipped<F: Float>(mask: F::Mask, w: Xyz<F>) -> Xyz<F> {
    Xyz { z: F::select(mask, -w.z, w.z), ..w }
}
