//! The watertight ray-triangle test of Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection", in the form of
//! PBRT 3rd edition, section 3.6.2: formulas for one ray and one triangle, one ray and several triangles, or several rays
//! and one triangle.
//!
//! In the sheared space the ray is the z axis, and the signs of three edge functions tell on which side of it each edge
//! passes. Triangles that share an edge compute the same numbers for it, so no ray slips between them. An edge function
//! that is exactly zero has to be recomputed in f64, in which the products are exact.

use crate::geometry::float::gamma;
use crate::simd::{Float, LaneMask, splat3};

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

/// Where a ray crosses the plane of a triangle.
#[derive(Clone, Copy)]
pub(crate) struct Crossing<F> {
    edges: [F; 3],
    /// The sum of the edge functions: divided by it they are the barycentric coordinates.
    pub determinant: F,
    /// z, and the distance along the ray, in lengths of its direction.
    depth: F,
    pub t: F,
}

impl<F: Float> Crossing<F> {
    /// t is NaN if all edge functions are zero.
    #[inline(always)]
    pub fn new(Edges(edges): Edges<F>, z: [F; 3], ray: &ShearedRay<F>) -> Self {
        let [a, b, c] = edges;
        let determinant = a + b + c;
        // Depth before t: products with the scaled z could exceed the range of f32.
        let depth = (a * z[0] + b * z[1] + c * z[2]) / determinant;
        Self { edges, determinant, depth, t: depth * ray.shear[2] }
    }

    /// Whether t is in a range.
    #[inline(always)]
    pub fn is_within(&self, t_min: F, t_max: F) -> F::Mask {
        t_min.le(self.t) & self.t.le(t_max)
    }

    /// Whether the crossing is certainly in front of the origin: t is beyond its error bound, or the triangle is beyond
    /// [`FAR`].
    #[inline(always)]
    pub fn is_in_front(&self, [x, y, z]: [[F; 3]; 3]) -> F::Mask {
        let is_positive = self.t.gt(F::splat(0.0));
        let max_z = max_abs(z);
        let delta_z = F::splat(gamma(3)) * max_z;
        let (low, high) = (z[0].min(z[1].min(z[2])), z[0].max(z[1].max(z[2])));
        let is_far = (F::splat(FAR) * (high - low) + delta_z).lt(low.max(-high));
        if is_far.all() {
            return is_positive;
        }
        // PBRT 3rd edition, section 3.9.6, which scales z to be t.
        let (max_x, max_y, max_e) = (max_abs(x), max_abs(y), max_abs(self.edges));
        let delta_x = F::splat(gamma(5)) * (max_x + max_z);
        let delta_y = F::splat(gamma(5)) * (max_y + max_z);
        let delta_e = F::splat(2.0)
            * (F::splat(gamma(2)) * max_x * max_y + delta_y * max_x + delta_x * max_y);
        let sum = F::splat(gamma(3)) * max_e * max_z + delta_e * max_z + delta_z * max_e;
        let bound = F::splat(3.0) * sum / self.determinant.abs();
        is_positive & (is_far | self.depth.abs().gt(bound))
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
