//! Bump mapping.

use glam::{Vec2, Vec3};

use crate::geometry::unit_cross;
use crate::interaction::{Shading, SurfaceInteraction};
use crate::texture::Texture;

/// The step in u and v of the difference quotient (PBRT's value when a ray carries no differentials).
const STEP: f32 = 0.0005;

/// The least step in units of the last place of the coordinate: what a texture loses by rounding, far
/// from 0, shall stay small against the difference.
const LEAST_STEP: f32 = 64.0 * f32::EPSILON;

/// Tilts the shading frame as if the surface were displaced along its normal by `displacement`.
///
/// With d the displacement, the displaced surface p' = p + d n has the derivative
/// ∂p'/∂u = ∂p/∂u + ∂d/∂u n + d ∂n/∂u (PBRT 3rd edition, section 9.3, equation 9.1), and ∂d/∂u
/// is a forward difference. Where that gives nothing usable the frame is left as it is.
pub fn bump(displacement: &dyn Texture<f32>, si: &mut SurfaceInteraction) {
    let shading = si.shading();
    let here = displacement.evaluate(si);
    let slope = |axis: Vec2, dpdu: Vec3, dndu: Vec3| {
        let du = exact_step(si.uv().dot(axis));
        let normal = (shading.n + du * dndu).normalize_or(shading.n);
        let moved = si.moved_to(si.p() + du * dpdu, si.uv() + du * axis, normal);
        dpdu + (displacement.evaluate(&moved) - here) / du * shading.n + here * dndu
    };
    let dpdu = slope(Vec2::X, shading.dpdu, shading.dndu);
    let dpdv = slope(Vec2::Y, shading.dpdv, shading.dndv);
    if let Some(n) = unit_cross(dpdu, dpdv) {
        // A mirrored parameterisation turns the cross product inwards: the geometric normal is right.
        let n = if n.dot(si.n()) < 0.0 { -n } else { n };
        si.set_shading(Shading { n, dpdu, dpdv, ..shading });
    }
}

/// A step from `x` that float arithmetic takes exactly.
fn exact_step(x: f32) -> f32 {
    (x + STEP.max(LEAST_STEP * x.abs())) - x
}
