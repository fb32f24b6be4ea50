//! The watertight ray-triangle test of Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection", in the form of
//! PBRT 3rd edition, section 3.6.2: formulas for one ray and one triangle, one ray and several triangles, or several rays
//! and one triangle.
//!
//! In the sheared space the ray is the z axis, and the signs of three edge functions tell on which side of it each edge
//! passes. Triangles that share an edge compute the same numbers for it, so no ray slips between them. An edge function
//! that is exactly zero has to be recomputed in f64, in which the products are exact.

use crate::geometry::float::gamma;
use crate::simd::{Float, LaneMask, splat3};

/// The relative error that t may have, of what is no needle seen from the ray: see [`Crossing::is_sure`].
pub(crate) const T_TOLERANCE: f32 = 1.0 / (1 << 11) as f32;

/// A ray prepared for the triangle test: the permutation of axes and the shear that turn its
/// direction into +z.
#[derive(Clone, Copy, Debug)]
pub struct ShearedRay<F = f32> {
    /// The origin, in permuted coordinates.
    pub(crate) o: [F; 3],
    /// The axes that become x, y and z. z is the axis along which the direction is longest.
    pub(crate) axes: [usize; 3],
    /// The shear: factors of z that are added to x and to y, and the factor from z to t.
    pub(crate) shear: [F; 3],
}

/// Whether x is the axis along which a direction is longest; if not, whether it is y.
#[inline(always)]
pub(crate) fn longest_axis<F: Float>([x, y, z]: [F; 3]) -> [F::Mask; 2] {
    let (x, y, z) = (x.abs(), y.abs(), z.abs());
    [x.gt(y) & x.gt(z), y.gt(z)]
}

impl<F: Float> ShearedRay<F> {
    /// From the axes, and origin and direction in permuted coordinates.
    #[inline(always)]
    pub(crate) fn permuted(axes: [usize; 3], o: [F; 3], [x, y, z]: [F; 3]) -> Self {
        Self { o, axes, shear: [-x / z, -y / z, F::splat(1.0) / z] }
    }

    /// z of a point, seen from the origin.
    #[inline(always)]
    pub(crate) fn z(&self, z: F) -> F {
        z - self.o[2]
    }

    /// x (`i` = 0) or y of a point in the sheared space.
    #[inline(always)]
    pub(crate) fn sheared(&self, i: usize, x: F, z: F) -> F {
        x - self.o[i] + self.shear[i] * z
    }

    /// The corners of a triangle in the sheared space: x of all three, y, and z. `coordinates` returns one coordinate of
    /// all, given the axis.
    #[inline(always)]
    pub(crate) fn corners(&self, coordinates: impl Fn(usize) -> [f32; 3]) -> [[F; 3]; 3] {
        let [a, b, c] = splat3(coordinates(self.axes[2]));
        let z = [self.z(a), self.z(b), self.z(c)];
        let [a, b, c] = splat3(coordinates(self.axes[0]));
        let x = [self.sheared(0, a, z[0]), self.sheared(0, b, z[1]), self.sheared(0, c, z[2])];
        let [a, b, c] = splat3(coordinates(self.axes[1]));
        let y = [self.sheared(1, a, z[0]), self.sheared(1, b, z[1]), self.sheared(1, c, z[2])];
        [x, y, z]
    }
}

/// The edge functions of the edges opposite to each corner: twice the signed area of (origin, p, q), seen along z.
#[derive(Clone, Copy)]
pub(crate) struct Edges<F>(pub [F; 3]);

impl<F: Float> Edges<F> {
    #[inline(always)]
    pub fn new([xa, xb, xc]: [F; 3], [ya, yb, yc]: [F; 3]) -> Self {
        Self([xb * yc - yb * xc, xc * ya - yc * xa, xa * yb - ya * xb])
    }

    /// Whether any is zero, so that only f64 can tell its sign.
    #[inline(always)]
    pub fn any_zero(self) -> F::Mask {
        let ([a, b, c], zero) = (self.0, F::splat(0.0));
        a.eq(zero) | b.eq(zero) | c.eq(zero)
    }

    /// Whether the ray passes the triangle inside: no two have opposite signs.
    #[inline(always)]
    pub fn inside(self) -> F::Mask {
        let ([a, b, c], zero) = (self.0, F::splat(0.0));
        a.min(b.min(c)).ge(zero) | a.max(b.max(c)).le(zero)
    }
}

/// How far the corners of a triangle reach in the sheared space.
#[derive(Clone, Copy)]
pub(crate) struct Reach<F> {
    /// The largest absolute x and y.
    x: F,
    y: F,
    /// The smallest and the largest z, and the largest absolute one.
    low: F,
    high: F,
    z: F,
}

impl<F: Float> Reach<F> {
    #[inline(always)]
    pub fn new([x, y, z]: [[F; 3]; 3]) -> Self {
        let (low, high) = (z[0].min(z[1].min(z[2])), z[0].max(z[1].max(z[2])));
        Self { x: max_abs(x), y: max_abs(y), low, high, z: high.max(-low) }
    }
}

/// Where a ray crosses the plane of a triangle.
#[derive(Clone, Copy)]
pub(crate) struct Crossing<F> {
    /// The edge functions: divided by their sum they are the barycentric coordinates.
    pub edges: [F; 3],
    pub determinant: F,
    /// The sum of the corners' z, each times its edge function.
    weighted: F,
    /// z, and the distance along the ray, in lengths of its direction.
    depth: F,
    pub t: F,
}

impl<F: Float> Crossing<F> {
    /// t is NaN if all edge functions are zero.
    #[inline(always)]
    pub fn new(Edges(edges): Edges<F>, z: [F; 3], t_per_depth: F) -> Self {
        let [a, b, c] = edges;
        let determinant = a + b + c;
        let weighted = a * z[0] + b * z[1] + c * z[2];
        // Depth before t: products with the scaled z could exceed the range of f32.
        let depth = weighted / determinant;
        Self { edges, determinant, weighted, depth, t: depth * t_per_depth }
    }

    /// Whether t is in a range.
    #[inline(always)]
    pub fn is_within(&self, t_min: F, t_max: F) -> F::Mask {
        t_min.le(self.t) & self.t.le(t_max)
    }

    /// Whether t is certainly off by less than [`T_TOLERANCE`] of itself. It may not be where a triangle is a needle as the ray
    /// sees it.
    ///
    /// Depth is a mean of the corners' z by weights that are computed, so each weight's error moves it within the range of z. By
    /// PBRT 3rd edition, section 3.9.6, an edge function is off by 2 γ₅ (y (x + z) + x (y + z)) at most, with the
    /// largest absolute coordinates; three of them, over the determinant, times the range of z, over the depth.
    #[inline(always)]
    pub fn is_sure(&self, reach: &Reach<F>) -> F::Mask {
        const FACTOR: f32 = 6.0 * gamma(5) / T_TOLERANCE;
        let Reach { x, y, z, .. } = *reach;
        let range = F::splat(FACTOR) * (reach.high - reach.low);
        // Not `le`: infinite products are not sure.
        ((x * (y + z) + y * (x + z)) * range).lt(self.weighted.abs())
    }

    /// Whether the crossing is certainly in front of the origin: t is beyond its error bound, or the triangle is beyond
    /// [`FAR`]. Unspecified but for lanes `among`.
    #[inline(always)]
    pub fn is_in_front(&self, reach: &Reach<F>, among: F::Mask) -> F::Mask {
        let is_positive = self.t.gt(F::splat(0.0));
        let Reach { x: max_x, y: max_y, low, high, z: max_z } = *reach;
        let delta_z = F::splat(gamma(3)) * max_z;
        let is_far = (F::splat(FAR) * (high - low) + delta_z).lt(low.max(-high));
        if (is_far | !among).all() {
            return is_positive;
        }
        // PBRT 3rd edition, section 3.9.6, which scales z to be t.
        let max_e = max_abs(self.edges);
        let delta_x = F::splat(gamma(5)) * (max_x + max_z);
        let delta_y = F::splat(gamma(5)) * (max_y + max_z);
        let delta_e = F::splat(2.0)
            * (F::splat(gamma(2)) * max_x * max_y + delta_y * max_x + delta_x * max_y);
        let sum = F::splat(gamma(3)) * max_e * max_z + delta_e * max_z + delta_z * max_e;
        let bound = F::splat(3.0) * sum / self.determinant.abs();
        is_positive & (is_far | self.depth.abs().gt(bound))
    }
}

impl Crossing<f32> {
    /// The same with t moved to where the ray is inside the box of the triangle, in which it is computed that the ray meets it.
    /// `coordinates` returns one coordinate of all corners, given the axis.
    #[cold]
    pub fn confined(
        self,
        reach: &Reach<f32>,
        ray: &ShearedRay,
        coordinates: impl Fn(usize) -> [f32; 3],
    ) -> Self {
        if self.depth.is_nan() {
            return self;
        }
        let (mut enter, mut leave) = (reach.low, reach.high);
        for i in (0..2).filter(|&i| ray.shear[i] != 0.0) {
            let depths = coordinates(ray.axes[i]).map(|x| (x - ray.o[i]) / -ray.shear[i]);
            enter = enter.max(depths.into_iter().fold(reach.high, f32::min));
            leave = leave.min(depths.into_iter().fold(reach.low, f32::max));
        }
        let depth = self.depth.min(leave).max(enter);
        Self { depth, t: depth * ray.shear[2], ..self }
    }
}

/// Ratio of distance to depth range beyond which a triangle surely lies in front of the origin, or
/// behind it.
///
/// Beyond it the error bound of the depth is not applied. The bound grows with the square of the
/// distance: at 10⁵ sizes of a triangle it would reject all hits, and closer than that those on
/// triangles seen edge-on. But if all corners lie in front, so does the hit. The bound's other
/// purpose is to reject hits on the neighbours of the triangle that a ray leaves, and these are
/// near.
const FAR: f32 = 8.0;

/// The largest absolute value.
#[inline(always)]
fn max_abs<F: Float>([a, b, c]: [F; 3]) -> F {
    a.abs().max(b.abs()).max(c.abs())
}
