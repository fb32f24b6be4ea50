//! The triangle test of Möller and Trumbore.

use lobe::geometry::Ray;
use lobe::glam::Vec3;

/// The t > 0 at which a ray hits a triangle. Directions have unit length.
///
/// Möller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection": Cramer's rule for
/// o + t d = p0 + u e1 + v e2. A ray counts as parallel to the triangle if the determinant is within `epsilon` of zero; the
/// paper has 1e-6.
pub fn moeller_trumbore(ray: &Ray, [p0, p1, p2]: &[Vec3; 3], epsilon: f32) -> Option<f32> {
    let (e1, e2, from) = (p1 - p0, p2 - p0, ray.o - p0);
    let across = ray.d.cross(e2);
    let along = from.cross(e1);
    let determinant = e1.dot(across);
    if determinant.abs() <= epsilon {
        return None;
    }
    let [u, v, t] = [from.dot(across), ray.d.dot(along), e2.dot(along)].map(|x| x / determinant);
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}
