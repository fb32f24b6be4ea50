//! Triangles: geometric normals, and the watertight ray-triangle test.

use glam::{DVec3, Vec3, Vec3A, Vec3Swizzles};

use crate::geometry::float::gamma;
use crate::geometry::{Ray, Xyz};
use crate::simd::Float;

/// The unit normal of a triangle, on the side from which its corners are counter-clockwise; zero
/// for a degenerate triangle.
#[inline]
pub fn triangle_normal([p0, p1, p2]: [Vec3; 3]) -> Vec3 {
    let corners = [p0, p1, p2];
    let (n, is_precise) = triangle_normal_wide([p0.into(), p1.into(), p2.into()]);
    if is_precise { n.into() } else { triangle_normal_f64(corners) }
}

#[cold]
fn triangle_normal_f64(corners: [Vec3; 3]) -> Vec3 {
    let [p0, p1, p2] = corners.map(DVec3::from);
    (p1 - p0).cross(p2 - p0).normalize_or_zero().as_vec3()
}

/// [`triangle_normal`] in each lane, and where f32 is precise enough. The normals of other lanes are not usable.
#[inline(always)]
pub(crate) fn triangle_normal_wide<F: Float>([p0, p1, p2]: [Xyz<F>; 3]) -> (Xyz<F>, F::Mask) {
    let (e1, e2) = (p1 - p0, p2 - p0);
    let n = e1.cross(e2);
    let length2 = n.length_squared();
    // Nearly parallel edges, with a sine below 1/10, cancel in the cross product: f64 is used. So
    // it is where squares exceed the range of f32 or lose digits in it.
    let wide = length2.gt(F::splat(0.01) * e1.length_squared() * e2.length_squared());
    let is_precise = wide
        & length2.gt(F::splat(f32::MIN_POSITIVE / f32::EPSILON))
        & length2.lt(F::splat(f32::INFINITY));
    (n / length2.sqrt(), is_precise)
}

/// A ray prepared for the triangle test: the permutation of axes and the shear that turn its
/// direction into +z.
#[derive(Clone, Copy, Debug)]
pub struct ShearedRay {
    /// The origin, in permuted coordinates.
    pub(crate) o: [f32; 3],
    /// The axes that become x, y and z. z is the axis along which the direction is longest.
    pub(crate) axes: [usize; 3],
    /// The shear: factors of z that are added to x and to y, and the factor from z to t.
    pub(crate) shear: [f32; 3],
}

/// Intersection of a ray with a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// Distance along the ray, in lengths of its direction.
    pub t: f32,
    /// Barycentric coordinates: the weights of the corners.
    pub b: [f32; 3],
}

impl ShearedRay {
    /// Prepares a ray whose direction is finite and not zero.
    #[inline]
    pub fn new(ray: &Ray) -> Self {
        let axes = Self::axes_of(ray);
        // By reference, so that coordinates are read in place.
        let (d, o): (&[f32; 3], &[f32; 3]) = (ray.d.as_ref(), ray.o.as_ref());
        let [x, y, z] = axes;
        let shear = Vec3A::new(-d[x], -d[y], 1.0) / d[z];
        Self { o: [o[x], o[y], o[z]], axes, shear: shear.to_array() }
    }

    /// The axes that become x, y and z: a cyclic permutation.
    #[inline]
    pub(crate) fn axes_of(ray: &Ray) -> [usize; 3] {
        let size = ray.d.abs();
        if size.x > size.y && size.x > size.z {
            [1, 2, 0]
        } else if size.y > size.z {
            [2, 0, 1]
        } else {
            [0, 1, 2]
        }
    }

    /// The intersection with t in `[t_min, t_max]`. `None` if there is none, or if t is within its
    /// error bound of zero: such a hit may lie behind the origin.
    ///
    /// The watertight test of Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection",
    /// in the form of PBRT 3rd edition, section 3.6.2. In the sheared space the ray is the z axis,
    /// and the signs of three edge functions tell on which side of it each edge passes. Triangles
    /// that share an edge compute the same numbers for it, so no ray slips between them. An edge
    /// function that is exactly zero is recomputed in f64, in which the products are exact.
    #[inline]
    pub fn intersect(&self, corners: &[Vec3; 3], t_min: f32, t_max: f32) -> Option<TriangleHit> {
        let corners = corners.map(|corner| corner.to_array());
        self.intersect_at(|axis| corners.map(|corner| corner[axis]), t_min, t_max)
    }

    /// [`ShearedRay::intersect`] for corners stored in any layout: `coordinates` returns one
    /// coordinate of all three corners, given the axis.
    #[inline(always)]
    pub(crate) fn intersect_at(
        &self,
        coordinates: impl Fn(usize) -> [f32; 3],
        t_min: f32,
        t_max: f32,
    ) -> Option<TriangleHit> {
        // One permuted coordinate of all three corners, relative to the origin of the ray.
        let along = |i: usize| {
            let axis = self.axes[i];
            Vec3A::from(coordinates(axis)) - Vec3A::splat(self.o[i])
        };
        let (x, y, z) = (along(0), along(1), along(2));
        let x = x + self.shear[0] * z;
        let y = y + self.shear[1] * z;
        // The edge function of the edge opposite to each corner.
        let mut e = x.yzx() * y.zxy() - y.yzx() * x.zxy();
        if e.cmpeq(Vec3A::ZERO).any() {
            e = edges_f64(x, y);
        }
        if e.cmplt(Vec3A::ZERO).any() && e.cmpgt(Vec3A::ZERO).any() {
            return None;
        }
        let determinant = sum(e);
        if determinant == 0.0 {
            return None;
        }
        // Depth before t: products with the scaled z could exceed the range of f32.
        let depth = sum(e * z) / determinant;
        let t = depth * self.shear[2];
        let in_range = t >= t_min
            && t <= t_max
            && t > 0.0
            && depth.abs() > least_depth([x, y, z], e, determinant);
        in_range.then(|| TriangleHit { t, b: (e / determinant).to_array() })
    }
}

/// The sum, in the order x, y, z.
#[inline]
fn sum(v: Vec3A) -> f32 {
    v.x + v.y + v.z
}

/// The edge functions in f64: twice the signed areas of (origin, p, q) in the xy plane. The
/// products are exact, so the signs are.
#[cold]
fn edges_f64(x: Vec3A, y: Vec3A) -> Vec3A {
    let edge = |p: usize, q: usize| {
        let difference = f64::from(x[p]) * f64::from(y[q]) - f64::from(y[p]) * f64::from(x[q]);
        // A non-zero value must not underflow to zero in f32.
        let rounded = difference as f32;
        if rounded == 0.0 && difference != 0.0 {
            f32::MIN_POSITIVE.copysign(difference as f32)
        } else {
            rounded
        }
    };
    Vec3A::new(edge(1, 2), edge(2, 0), edge(0, 1))
}

/// Ratio of distance to depth range beyond which a triangle surely lies in front of the origin, or
/// behind it.
///
/// Beyond it the error bound of the depth is not applied. The bound grows with the square of the
/// distance: at 10⁵ sizes of a triangle it would reject all hits, and closer than that those on
/// triangles seen edge-on. But if all corners lie in front, so does the hit. The bound's other
/// purpose is to reject hits on the neighbours of the triangle that a ray leaves, and these are
/// near.
pub(crate) const FAR: f32 = 8.0;

/// Error bound of the depth: a hit at or below it may lie behind the origin (PBRT 3rd edition,
/// section 3.9.6, which scales z to be t). Zero for triangles beyond [`FAR`].
#[inline]
fn least_depth([x, y, z]: [Vec3A; 3], e: Vec3A, determinant: f32) -> f32 {
    let [max_x, max_y, max_z] = [x, y, z].map(|v| v.abs().max_element());
    let delta_z = gamma(3) * max_z;
    let (low, high) = (z.min_element(), z.max_element());
    if FAR * (high - low) + delta_z < low.max(-high) {
        return 0.0;
    }
    let delta_x = gamma(5) * (max_x + max_z);
    let delta_y = gamma(5) * (max_y + max_z);
    let delta_e = 2.0 * (gamma(2) * max_x * max_y + delta_y * max_x + delta_x * max_y);
    let max_e = e.abs().max_element();
    3.0 * (gamma(3) * max_e * max_z + delta_e * max_z + delta_z * max_e) / determinant.abs()
}
