//! The steps of the watertight triangle test in all lanes, as [`crate::shape::ShearedRay`] takes them for one triangle
//! and one ray (Woop, Benthin and Wald 2013).

use crate::geometry::float::gamma;
use crate::shape::FAR;
use crate::simd::{Lanes, Vector};

/// Edge function: twice the signed area of the triangle (origin, p, q) seen along z.
#[inline(always)]
pub fn edge_function<V: Vector>(px: V, py: V, qx: V, qy: V) -> V {
    px.mul(qy).sub(py.mul(qx))
}

/// Bound on the rounding error of the depth: a hit that is not deeper may be behind the origin. As for one triangle.
#[inline(always)]
pub fn depth_error_bound<L: Lanes>([a, b, c]: [[L; 3]; 3], e: [L; 3], determinant: L) -> L {
    let max_x = max_abs(a[0], b[0], c[0]);
    let max_y = max_abs(a[1], b[1], c[1]);
    let max_z = max_abs(a[2], b[2], c[2]);
    let (gamma2, gamma3, gamma5) = (L::splat(gamma(2)), L::splat(gamma(3)), L::splat(gamma(5)));
    let delta_z = gamma3.mul(max_z);
    let delta_x = gamma5.mul(max_x.add(max_z));
    let delta_y = gamma5.mul(max_y.add(max_z));
    let products = gamma2.mul(max_x).mul(max_y).add(delta_y.mul(max_x)).add(delta_x.mul(max_y));
    let delta_e = L::splat(2.0).mul(products);
    let max_e = max_abs(e[0], e[1], e[2]);
    let sum = gamma3.mul(max_e).mul(max_z).add(delta_e.mul(max_z)).add(delta_z.mul(max_e));
    let low = a[2].min(b[2].min(c[2]));
    let high = a[2].max(b[2].max(c[2]));
    let nearest = low.max(L::splat(0.0).sub(high));
    let is_far = L::splat(FAR).mul(high.sub(low)).add(delta_z).lt(nearest);
    L::splat(3.0).mul(sum).div(determinant.abs()).blend(is_far, L::splat(0.0))
}

/// The largest absolute value of three.
#[inline(always)]
fn max_abs<V: Vector>(a: V, b: V, c: V) -> V {
    a.abs().max(b.abs()).max(c.abs())
}

/// x or y of three points, sheared along z.
#[inline(always)]
pub fn sheared<V: Vector>([a, b, c]: [V; 3], shear: V, z: [V; 3]) -> [V; 3] {
    [a.add(shear.mul(z[0])), b.add(shear.mul(z[1])), c.add(shear.mul(z[2]))]
}
