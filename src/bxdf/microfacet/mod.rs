//! Rough surfaces as many small smooth ones: their distribution, and what light loses that meets more than one of them.

mod azimuths;
mod boundary_losses;
mod ggx;
mod losses;
pub(super) mod multiple;
mod returned;
mod row;

use glam::Vec3;

pub use boundary_losses::BoundaryLosses;
pub use ggx::Ggx;
pub use losses::{Losses, Roughnesses};

/// Two directions mirrored so that the first is above the surface.
#[inline]
pub(super) fn above(wo: Vec3, wi: Vec3) -> [Vec3; 2] {
    if wo.z < 0.0 { [wo, wi].map(flipped) } else { [wo, wi] }
}

/// The direction on the other side of the surface.
#[inline]
pub(super) fn flipped(w: Vec3) -> Vec3 {
    Vec3::new(w.x, w.y, -w.z)
}
