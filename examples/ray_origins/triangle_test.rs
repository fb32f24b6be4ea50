//! The two triangle tests that the rays are tried with.

use lobe::geometry::Ray;
use lobe::glam::Vec3;
use lobe::shape::ShearedRay;

/// Whether a ray hits a triangle, as told by a test.
pub type TriangleTest = fn(&Ray, &[Vec3; 3]) -> bool;

/// Both tests, in the order of the counts.
pub const TESTS: [TriangleTest; 2] = [bounded, plain];

/// The crate's test, which takes no hit at a t within the bound of its error.
fn bounded(ray: &Ray, corners: &[Vec3; 3]) -> bool {
    ShearedRay::new(ray).intersect(corners, ray.t_min, ray.t_max).is_some()
}

/// The common test, which takes every hit at t > 0.
///
/// Möller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection": Cramer's rule for
/// o + t d = p0 + u e1 + v e2.
fn plain(ray: &Ray, [p0, p1, p2]: &[Vec3; 3]) -> bool {
    let (e1, e2, from) = (p1 - p0, p2 - p0, ray.o - p0);
    let across = ray.d.cross(e2);
    let along = from.cross(e1);
    let determinant = e1.dot(across);
    if determinant == 0.0 {
        return false;
    }
    let [u, v, t] = [from.dot(across), ray.d.dot(along), e2.dot(along)].map(|x| x / determinant);
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0
}
