//! Triangles: geometric normals, and the test of one ray against one triangle.

use std::hint::select_unpredictable;

use glam::{DVec3, Vec3, Vec3A};

use super::watertight::{Crossing, Edges, Reach, ShearedRay, longest_axis};
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
        Self::permuted(axes, [o[x], o[y], o[z]], [d[x], d[y], d[z]])
    }

    /// The axes that become x, y and z: a cyclic permutation.
    #[inline]
    pub(crate) fn axes_of(ray: &Ray) -> [usize; 3] {
        let [x, y] = longest_axis(ray.d.to_array());
        let pick = |a: usize, b: usize, c: usize| {
            select_unpredictable(x, a, select_unpredictable(y, b, c))
        };
        [pick(1, 2, 0), pick(2, 0, 1), pick(0, 1, 2)]
    }

    /// The intersection with t in `[t_min, t_max]`. `None` if there is none, or if t is within its
    /// error bound of zero: such a hit may lie behind the origin.
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
        let corners = self.corners(&coordinates);
        let [x, y, z] = corners;
        let mut edges = Edges::new(x, y);
        if edges.any_zero() {
            edges = edges_f64(x, y);
        }
        if !edges.inside() {
            return None;
        }
        let reach = Reach::new(corners);
        let mut crossing = Crossing::new(edges, z, self.shear[2]);
        if !crossing.is_in_front(&reach, true) {
            return None;
        }
        if !crossing.is_sure(&reach) {
            crossing = crossing.confined(&reach, self, coordinates);
        }
        crossing.is_within(t_min, t_max).then(|| {
            let b = Vec3A::from(edges.0) / crossing.determinant;
            TriangleHit { t: crossing.t, b: b.to_array() }
        })
    }
}

/// The edge functions in f64, in which the products are exact, so that the signs are.
#[cold]
fn edges_f64(x: [f32; 3], y: [f32; 3]) -> Edges<f32> {
    let Edges(exact) = Edges::new(x.map(f64::from), y.map(f64::from));
    Edges(exact.map(|e| {
        // A non-zero value must not underflow to zero in f32.
        let rounded = e as f32;
        if rounded == 0.0 && e != 0.0 { f32::MIN_POSITIVE.copysign(rounded) } else { rounded }
    }))
}
