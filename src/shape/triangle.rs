//! The triangle: its normal, and whether and where a ray meets it.

use glam::{DVec3, Vec3};

use crate::geometry::Ray;
use crate::geometry::float::gamma;

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

/// A ray prepared for the triangle test: shear and permutation that turn it into the +z axis.
#[derive(Clone, Copy, Debug)]
pub struct ShearedRay {
    o: Vec3,
    /// The axes that become x, y and z; z is where the direction is longest.
    axes: [usize; 3],
    /// What is added to x and y in proportion to z, and the factor of z.
    shear: Vec3,
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
        let size = ray.d.abs();
        let z = if size.x > size.y && size.x > size.z {
            0
        } else if size.y > size.z {
            1
        } else {
            2
        };
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let [dx, dy, dz] = axes.map(|axis| ray.d[axis]);
        Self { o: ray.o, axes, shear: Vec3::new(-dx / dz, -dy / dz, 1.0 / dz) }
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
        let [a, b, c] = corners.map(|p| self.to_ray_space(p));
        let (mut e0, mut e1, mut e2) = (edge(b, c), edge(c, a), edge(a, b));
        if e0 == 0.0 || e1 == 0.0 || e2 == 0.0 {
            (e0, e1, e2) = (edge_f64(b, c), edge_f64(c, a), edge_f64(a, b));
        }
        if (e0 < 0.0 || e1 < 0.0 || e2 < 0.0) && (e0 > 0.0 || e1 > 0.0 || e2 > 0.0) {
            return None;
        }
        let determinant = e0 + e1 + e2;
        if determinant == 0.0 {
            return None;
        }
        // z is scaled only here: most triangles have been left by now.
        let z = Vec3::new(a.z, b.z, c.z) * self.shear.z;
        let t_scaled = e0 * z.x + e1 * z.y + e2 * z.z;
        let t = t_scaled / determinant;
        let e = Vec3::new(e0, e1, e2);
        let in_range = t >= t_min && t <= t_max && t > least_t([a, b, c], z, e, determinant);
        in_range.then(|| TriangleHit { t, b: (e / determinant).to_array() })
    }

    /// A point in the space where the ray starts at the origin and runs along +z; z is not scaled yet.
    #[inline]
    fn to_ray_space(self, p: Vec3) -> Vec3 {
        let p = p - self.o;
        let [x, y, z] = self.axes.map(|axis| p[axis]);
        Vec3::new(x + self.shear.x * z, y + self.shear.y * z, z)
    }
}

/// Twice the signed area of the triangle (origin, p, q) seen along z.
#[inline]
fn edge(p: Vec3, q: Vec3) -> f32 {
    p.x * q.y - p.y * q.x
}

/// [`edge`] with the sign of the exact value: both products fit into an f64.
#[cold]
fn edge_f64(p: Vec3, q: Vec3) -> f32 {
    let difference = f64::from(p.x) * f64::from(q.y) - f64::from(p.y) * f64::from(q.x);
    // A value too small for f32 must not become zero.
    let rounded = difference as f32;
    if rounded == 0.0 && difference != 0.0 {
        f32::MIN_POSITIVE.copysign(difference as f32)
    } else {
        rounded
    }
}

/// The bound on the error of t: a hit at or below it may lie behind the origin
/// (PBRT 3rd edition, section 3.9.6).
///
/// The shear adds z in proportion to x and y before z is scaled, so that its error goes with z as it is.
/// PBRT takes the scaled z, which is the same only for directions of unit length.
#[inline]
fn least_t(corners: [Vec3; 3], z: Vec3, e: Vec3, determinant: f32) -> f32 {
    let max_of = |values: [f32; 3]| values[0].abs().max(values[1].abs()).max(values[2].abs());
    let max_x = max_of(corners.map(|p| p.x));
    let max_y = max_of(corners.map(|p| p.y));
    let max_unscaled_z = max_of(corners.map(|p| p.z));
    let max_z = z.abs().max_element();
    let delta_z = gamma(3) * max_z;
    let delta_x = gamma(5) * (max_x + max_unscaled_z);
    let delta_y = gamma(5) * (max_y + max_unscaled_z);
    let delta_e = 2.0 * (gamma(2) * max_x * max_y + delta_y * max_x + delta_x * max_y);
    let max_e = e.abs().max_element();
    3.0 * (gamma(3) * max_e * max_z + delta_e * max_z + delta_z * max_e) / determinant.abs()
}
