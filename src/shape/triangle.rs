//! The triangle: its normal, and whether and where a ray meets it.

use glam::{DVec3, Vec3, Vec3A, Vec3Swizzles, Vec4};

use crate::geometry::Ray;
use crate::geometry::float::gamma;
use crate::geometry::four::Vec3x4;

/// The unit normal of a triangle, on the side from which its corners run counter-clockwise; zero for
/// a triangle without area.
#[inline]
pub fn triangle_normal([p0, p1, p2]: [Vec3; 3]) -> Vec3 {
    let (e1, e2) = (p1 - p0, p2 - p0);
    let n = e1.cross(e2);
    let length2 = n.length_squared();
    // The products cancel where the edges run along each other: below a sine of 1/10, f64 is asked. So it
    // is where squares leave the range of f32 or lose digits in it.
    let wide = length2 > 0.01 * e1.length_squared() * e2.length_squared();
    if wide && length2 > f32::MIN_POSITIVE / f32::EPSILON && length2 < f32::INFINITY {
        return n / length2.sqrt();
    }
    triangle_normal_f64([p0, p1, p2])
}

#[cold]
fn triangle_normal_f64(corners: [Vec3; 3]) -> Vec3 {
    let [p0, p1, p2] = corners.map(DVec3::from);
    (p1 - p0).cross(p2 - p0).normalize_or_zero().as_vec3()
}

/// Four lanes of [`triangle_normal`], and whether f32 is precise enough in all of them: without it,
/// the normals are not usable.
#[inline(always)]
pub(crate) fn triangle_normals([p0, p1, p2]: [Vec3x4; 3]) -> (Vec3x4, bool) {
    let (e1, e2) = (p1 - p0, p2 - p0);
    let n = e1.cross(e2);
    let length2 = n.length_squared();
    let least = Vec4::splat(0.01) * e1.length_squared() * e2.length_squared();
    let sound = length2.cmpgt(least)
        & length2.cmpgt(Vec4::splat(f32::MIN_POSITIVE / f32::EPSILON))
        & length2.cmplt(Vec4::INFINITY);
    (n.divided_by(length2.sqrt()), sound.all())
}

/// A ray prepared for the triangle test: shear and permutation that turn it into the +z axis.
#[derive(Clone, Copy, Debug)]
pub struct ShearedRay {
    /// The origin, by the axes below.
    pub(crate) o: [f32; 3],
    /// The axes that become x, y and z; z is where the direction is longest.
    pub(crate) axes: [usize; 3],
    /// What is added to x and y in proportion to z, and how much t there is to z.
    pub(crate) shear: [f32; 3],
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// Distance in lengths of the ray's direction.
    pub t: f32,
    /// Barycentric weights of the corners.
    pub b: [f32; 3],
}

impl ShearedRay {
    /// Prepares a ray.
    #[inline]
    pub fn new(ray: &Ray) -> Self {
        let axes = Self::axes_of(ray);
        // By reference, so that coordinates are read from where they are.
        let (d, o): (&[f32; 3], &[f32; 3]) = (ray.d.as_ref(), ray.o.as_ref());
        let [x, y, z] = axes;
        let shear = Vec3A::new(-d[x], -d[y], 1.0) / d[z];
        Self { o: [o[x], o[y], o[z]], axes, shear: shear.to_array() }
    }

    /// The axes that become x, y and z.
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

    /// The hit with t in `[t_min, t_max]`, if there is one that rounding cannot have made up.
    ///
    /// Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection", in the form of
    /// PBRT 3rd edition, section 3.6.2: in the sheared space the ray is the z axis, and three edge
    /// functions say on which side of it each edge runs. Neighbouring triangles compute the same
    /// numbers for a shared edge, so a ray cannot slip between them. An edge function that is
    /// exactly zero is computed again in f64, which has room for the exact products.
    #[inline]
    pub fn intersect(&self, corners: &[Vec3; 3], t_min: f32, t_max: f32) -> Option<TriangleHit> {
        let corners = corners.map(|corner| corner.to_array());
        self.intersect_at(|axis| corners.map(|corner| corner[axis]), t_min, t_max)
    }

    /// [`ShearedRay::intersect`] for corners that are kept in any way: `coordinates` tells one of each
    /// corner.
    #[inline(always)]
    pub(crate) fn intersect_at(
        &self,
        coordinates: impl Fn(usize) -> [f32; 3],
        t_min: f32,
        t_max: f32,
    ) -> Option<TriangleHit> {
        // One coordinate of all three corners at a time, in the space where the ray starts at the origin
        // and runs along z.
        let along = |i: usize| {
            let axis = self.axes[i];
            Vec3A::from(coordinates(axis)) - Vec3A::splat(self.o[i])
        };
        let (x, y, z) = (along(0), along(1), along(2));
        let x = x + self.shear[0] * z;
        let y = y + self.shear[1] * z;
        // The edge opposite to each corner.
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
        // Depth first: products with a scaled z could leave the range of f32.
        let depth = sum(e * z) / determinant;
        let t = depth * self.shear[2];
        let in_range = t >= t_min
            && t <= t_max
            && t > 0.0
            && depth.abs() > least_depth([x, y, z], e, determinant);
        in_range.then(|| TriangleHit { t, b: (e / determinant).to_array() })
    }
}

/// The sum, from x to z.
#[inline]
fn sum(v: Vec3A) -> f32 {
    v.x + v.y + v.z
}

/// The edge functions, twice the signed areas of (origin, p, q) seen along z, with the signs of the exact
/// values: both products fit into an f64.
#[cold]
fn edges_f64(x: Vec3A, y: Vec3A) -> Vec3A {
    let edge = |p: usize, q: usize| {
        let difference = f64::from(x[p]) * f64::from(y[q]) - f64::from(y[p]) * f64::from(x[q]);
        // A value too small for f32 must not become zero.
        let rounded = difference as f32;
        if rounded == 0.0 && difference != 0.0 {
            f32::MIN_POSITIVE.copysign(difference as f32)
        } else {
            rounded
        }
    };
    Vec3A::new(edge(1, 2), edge(2, 0), edge(0, 1))
}

/// A triangle that is so many times farther away than it is deep surely lies ahead, or behind.
///
/// The bound on the depth grows with the square of the distance: at 10⁵ sizes of a triangle it would reject all hits, and
/// nearer those on triangles that are seen edge-on. But where all corners lie ahead, so does the hit. What the bound is
/// there for, besides, are the triangles that continue the one that a ray leaves: these are near.
pub(crate) const FAR: f32 = 8.0;

/// The bound on the error of the depth: a hit at or below it may lie behind the origin
/// (PBRT 3rd edition, section 3.9.6, where z is scaled to be t). Zero for triangles that are [`FAR`].
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
