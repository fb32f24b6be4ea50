//! Bump and normal mapping: textures that tilt the shading frame.

use glam::{Vec2, Vec3};

use crate::geometry::unit_cross;
use crate::interaction::{Shading, SurfaceInteraction};
use crate::spectrum::Spectrum;
use crate::texture::Texture;

/// Step in u and v of the finite difference (PBRT's value for rays without differentials).
const STEP: f32 = 0.0005;

/// Least step, relative to the coordinate. Far from 0, the rounding of a texture's value has to stay small
/// against the difference.
const MIN_STEP: f32 = 64.0 * f32::EPSILON;

/// Tilts the shading frame as if the surface were displaced along its normal by `displacement`.
///
/// With d the displacement, the displaced surface p' = p + d n has the derivative
/// ∂p'/∂u = ∂p/∂u + ∂d/∂u n + d ∂n/∂u (PBRT 3rd edition, section 9.3, equation 9.1), and ∂d/∂u
/// is a forward difference. If the derivatives span no plane, the frame stays as it is.
#[doc(alias = "displacement")]
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
        // A mirrored parameterisation flips the cross product: `set_shading` follows the geometric normal.
        si.set_shading(Shading { n, dpdu, dpdv, ..shading });
    }
}

/// A step from `x` for which `x + step` is exact in floating point.
fn exact_step(x: f32) -> f32 {
    (x + STEP.max(MIN_STEP * x.abs())) - x
}

/// Turns the shading normal to that of a texture, whose colours are (n + 1) / 2: red along ∂p/∂u, green along ∂p/∂v, blue along the
/// shading normal, as OpenGL and glTF have it. If the derivatives span no plane, or the normal does not point outwards, the frame stays as it
/// is.
#[doc(alias = "normal map")]
pub fn turn(normals: &dyn Texture<Spectrum>, si: &mut SurfaceInteraction) {
    let shading = si.shading();
    let [x, y, z] = normals.evaluate(si).to_array().map(|code| 2.0 * code - 1.0);
    let along_u = shading.dpdu.normalize_or_zero();
    let along_v = (shading.dpdv - along_u * along_u.dot(shading.dpdv)).normalize_or_zero();
    if z > 0.0 && along_u != Vec3::ZERO && along_v != Vec3::ZERO {
        let n = (along_u * x + along_v * y + shading.n * z).normalize();
        let [dpdu, dpdv] = [shading.dpdu, shading.dpdv].map(|v| v - n * n.dot(v));
        si.set_shading(Shading { n, dpdu, dpdv, ..shading });
    }
}
